// snip validate MESH: can this mesh be cut, and what does it consist of?
#include "cut/validate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "snip/commands/checks.hpp"
#include "snip/commands/commands.hpp"
#include "snip/commands/report.hpp"
#include "snip/console.hpp"
#include "snip/pieces.hpp"

namespace snip {
namespace {

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

Result<> run(const std::string& path) {
  const Result<Mesh> mesh = read_clean_mesh(path);
  if (!mesh) return mesh.error();
  const auto hybrid = cut::HybridMesh::build(to_triangle_mesh(*mesh));
  if (!hybrid) return explain(hybrid.error(), *mesh, path);
  const Pieces pieces = find_pieces(mesh->positions, mesh->triangles);
  print_out(fmt::format("{}: {} vertices, {}, {}\n", path, mesh->positions.size(),
                        counted(mesh->triangles.size(), "triangle"), counted(pieces.pieces.size(), "piece")));
  for (std::size_t p = 0; p < pieces.pieces.size(); ++p) {
    const Piece& piece = pieces.pieces[p];
    print_out(fmt::format("piece_{}: area {:.6g}, {}, {}, Euler characteristic {}\n", p, piece.area,
                          counted(piece.triangles, "triangle"),
                          counted(piece.boundary_loops, "boundary loop"), piece.euler_characteristic));
  }
  const std::vector<cut::Violation> violations = cut::validate(*hybrid);
  for (const cut::Violation& violation : violations)
    print_out(fmt::format("{}: {}\n", violation.rule, violation.message));
  if (!violations.empty())
    return Error{fmt::format("{}: {} found", path, counted(violations.size(), "violation"))};
  return {};
}

}  // namespace

void add_validate_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("validate", "Tell whether a mesh can be cut, and what it consists of");
  auto mesh = std::make_shared<std::string>();
  command->add_option("MESH", *mesh, "Mesh to look at (.obj, .ply, .stl, .off)")->required()->check(a_name());
  command->callback([mesh, &exit_code] { conclude(run(*mesh), exit_code); });
}

}  // namespace snip
