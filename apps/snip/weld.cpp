// Merges vertices; see the header.
#include "snip/weld.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "snip/mesh_file/polygon_soup.hpp"
#include "spatial/point_cluster_dictionary.hpp"

namespace snip {
namespace {

// The dictionary's grid reaches 2^30 distances from its origin. For a mesh that lies farther off, such as one
// in geodetic coordinates, that is laid into the middle of the mesh: differences are then rounded as
// coordinates of that size are.
Eigen::Vector3d origin_for(const std::vector<Eigen::Vector3d>& positions, double distance) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions) box.extend(position);
  const double farthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return box.isEmpty() || farthest < distance * 0x1p30 ? Eigen::Vector3d(0, 0, 0) : box.center();
}

}  // namespace

Result<std::size_t> weld(Mesh& mesh, double distance, std::string_view name) {
  if (!(distance > 0) || !std::isfinite(distance))
    return Error{fmt::format("the distance must be a positive number, not {}", distance)};

  // A normal that belongs to a vertex as a whole is merged with it; one of a corner stays as it is.
  const auto vertex_normals = attribute_of_vertices(mesh, mesh.normal_triangles, mesh.normals);
  const std::size_t before = mesh.positions.size();
  const Eigen::Vector3d origin = origin_for(mesh.positions, distance);
  spatial::PointClusterDictionary<double, 3, std::uint32_t> kept(distance);
  std::vector<std::uint32_t> kept_of(before);
  std::vector<std::uint32_t> normal_of_kept;
  for (std::size_t v = 0; v < before; ++v) {
    const Eigen::Vector3d position = mesh.positions[v];
    const auto next = static_cast<std::uint32_t>(kept.size());
    const Eigen::Vector3d from_origin = position - origin;
    const spatial::MergeResult merged =
        kept.insert_or_merge({from_origin.x(), from_origin.y(), from_origin.z()}, next);
    if (!merged.cluster.valid())
      return Error{
          fmt::format("{}: the distance {} cannot be used: the mesh is more than 2^30 times as large, or the "
                      "distance is out of range",
                      name, distance)};
    kept_of[v] = kept.value(merged.cluster);
    if (!merged.inserted) continue;
    // Kept vertices move up to the front, in their order.
    mesh.positions[next] = position;
    if (!mesh.colours.empty()) mesh.colours.values[next] = mesh.colours.values[v];
    if (vertex_normals) normal_of_kept.push_back((*vertex_normals)[v]);
  }
  mesh.positions.resize(kept.size());
  if (!mesh.colours.empty()) mesh.colours.values.resize(kept.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& corner = mesh.triangles[t][k];
      corner = kept_of[corner];
      if (vertex_normals && normal_of_kept[corner] != no_index)
        mesh.normal_triangles[t][k] = normal_of_kept[corner];
    }
  return before - kept.size();
}

}  // namespace snip
