// Tidies a mesh; see the header.
#include "snip/clean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace snip {
namespace {

bool is_degenerate(const Mesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  if (a == b || b == c || c == a) return true;
  return !cut::has_area(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
}

Triangle sorted(Triangle triangle) {
  std::ranges::sort(triangle);
  return triangle;
}

template <class T>
void keep_entries(std::vector<T>& entries, std::span<const unsigned char> keep) {
  if (entries.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) entries[kept++] = entries[i];
  entries.resize(kept);
}

std::size_t polygons_with_triangles(const Mesh& mesh) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (t == 0 || mesh.polygon_of_triangle[t] != mesh.polygon_of_triangle[t - 1]) ++count;
  return count;
}

}  // namespace

void keep_triangles(Mesh& mesh, std::span<const unsigned char> keep) {
  keep_entries(mesh.triangles, keep);
  keep_entries(mesh.polygon_of_triangle, keep);
  keep_entries(mesh.uv_triangles, keep);
  keep_entries(mesh.normal_triangles, keep);
}

Result<CleanReport> clean(Mesh& mesh, std::string_view name) {
  CleanReport report;
  report.degenerate = mesh.polygon_count - polygons_with_triangles(mesh);
  std::vector<unsigned char> keep(mesh.triangles.size(), 1);
  std::vector<std::pair<Triangle, std::size_t>> by_corners;
  by_corners.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_degenerate(mesh, mesh.triangles[t])) {
      keep[t] = 0;
      ++report.degenerate;
    } else {
      by_corners.emplace_back(sorted(mesh.triangles[t]), t);
    }
  }
  std::ranges::sort(by_corners);
  for (std::size_t i = 1; i < by_corners.size(); ++i)
    if (by_corners[i].first == by_corners[i - 1].first) {
      keep[by_corners[i].second] = 0;
      ++report.duplicates;
    }
  if (by_corners.empty())
    return Error{fmt::format("{}: no triangle is left: {} without area", name, report.degenerate)};
  keep_triangles(mesh, keep);
  return report;
}

std::string describe(const CleanReport& report, std::string_view name) {
  std::string text;
  const auto add = [&](std::size_t count, std::string_view what) {
    if (count == 0) return;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(report.degenerate, "without area");
  add(report.duplicates, "repeated");
  return text.empty() ? text : fmt::format("{}: dropped triangles: {}", name, text);
}

cut::TriangleMesh to_triangle_mesh(const Mesh& mesh) { return {mesh.positions, mesh.triangles}; }

}  // namespace snip
