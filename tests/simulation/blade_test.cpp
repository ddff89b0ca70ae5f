// A blade is led through a cloth that swings in the wind (§6, "Discontinuous Cutting Lines"): what it leaves
// is one unbroken line and two pieces. What the same blade leaves when each of its sweeps is cut for itself,
// by a Cutter that remembers the last one or by one that does not, is counted beside it: the table in
// docs/experiments.md.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cut/blade.hpp>
#include <cut/pieces.hpp>
#include <cut/validate.hpp>
#include <scenes/cutters.hpp>
#include <sstream>

#include "simulation/cut_lines.hpp"
#include "simulation/documents.hpp"
#include "simulation/meshes.hpp"

namespace {

constexpr int frames = 2000;

struct Outcome {
  std::size_t lines;
  std::vector<double> areas;  ///< of the pieces, largest first
};

/// A square metre, held at its upper border. `cut_to(mesh, edge)` leads the blade, once for each frame.
template <class CutTo>
Outcome lead_through(double wind, const CutTo& cut_to) {
  cut::TriangleMesh input = scenes::grid(20, 20, 0.05, scenes::Diagonals::alternating);
  for (Eigen::Vector3d& p : input.positions) p = {p.x(), 0, p.y()};
  cut::HybridMesh mesh = testing::built(input);
  cut::Material material;
  material.density = 0.3;
  material.stiffness = 60;
  material.damping = 0.1;
  cut::Simulation simulation = testing::simulated(mesh, material);
  simulation.surroundings.gravity = {0, 0, -9.81};
  simulation.surroundings.air_drag = 0.6;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    if (mesh.positions[n].z() > 0.99) simulation.anchor(cut::NodeId{n});
  for (int frame = 0; frame <= frames; ++frame) {
    const double way = static_cast<double>(frame) / frames;
    const double x = 1.6 * way - 0.3, z = 0.45 + 0.2 * std::sin(7 * way);
    const auto changes = cut_to(mesh, scenes::Path{{x, -2, z}, {x, 2, z + 0.05}});
    REQUIRE(changes.has_value());
    REQUIRE_FALSE(simulation.apply(*changes, mesh).has_value());
    if (frame % 100 == 0) REQUIRE(cut::validate(mesh, 3).empty());
    simulation.surroundings.wind = {0, wind * std::sin(0.021 * frame), 0};
    REQUIRE_FALSE(simulation.step(mesh, 0.0005, 20).has_value());
  }
  REQUIRE(cut::validate(mesh, 3).empty());
  Outcome outcome{testing::count_cut_lines(mesh), {}};
  for (const cut::Piece& piece : cut::pieces(mesh).list) outcome.areas.push_back(piece.rest_area);
  return outcome;
}

std::string in_words(const Outcome& outcome) {
  const auto& areas = outcome.areas;
  const auto crumbs = std::count_if(areas.begin(), areas.end(), [](double area) { return area < 0.001; });
  std::ostringstream text;
  text << ' ' << outcome.lines << " | " << areas.size() - static_cast<std::size_t>(crumbs);
  if (crumbs > 0) text << ", and " << crumbs << (crumbs == 1 ? " crumb" : " crumbs");
  text << " |";
  return text.str();
}

}  // namespace

TEST_CASE("a blade through a swinging cloth leaves one line and two pieces; sweeps cut one by one do not") {
  const cut::MergeDistances distances = cut::default_merge_distances(
      testing::built(scenes::grid(20, 20, 0.05, scenes::Diagonals::alternating)));
  std::ostringstream table;
  for (const double wind : {0.3, 0.7, 1.2}) {
    cut::Blade blade(distances);
    const Outcome led = lead_through(
        wind, [&](cut::HybridMesh& mesh, const scenes::Path& edge) { return blade.cut_to(mesh, edge); });
    CHECK(led.lines == 1);
    REQUIRE(led.areas.size() >= 2);
    CHECK(led.areas[1] > 0.4);
    // Where the cloth swings back over the blade's path, crumbs may come out.
    CHECK(led.areas[0] + led.areas[1] > 0.999);
    table << "| " << wind << " |" << in_words(led);

    for (const bool remembers : {true, false}) {
      cut::Cutter cutter(distances);
      scenes::Path before;
      const Outcome swept = lead_through(wind, [&](cut::HybridMesh& mesh, const scenes::Path& edge) {
        const cut::TriangleMesh sweep = before.empty() ? cut::TriangleMesh{} : scenes::swept(before, edge);
        before = edge;
        if (!remembers) cutter = cut::Cutter(distances);
        return cutter.cut(mesh, sweep);
      });
      CHECK(swept.lines > 2);
      table << in_words(swept);
    }
    table << '\n';
  }
  CHECK_MESSAGE(testing::page("experiments.md").find(table.str()) != std::string::npos, table.str());
}
