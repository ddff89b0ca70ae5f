// Merges vertices; see the header.
#include "snip/weld.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "snip/mesh_file/polygon_soup.hpp"
#include "spatial/point_cluster_dictionary.hpp"

namespace snip {

Result<std::size_t> weld(Mesh& mesh, double distance, std::string_view name) {
  if (!(distance > 0) || !std::isfinite(distance))
    return Error{fmt::format("the distance must be a positive number, not {}", distance)};

  // A normal that belongs to a vertex as a whole is merged with it; one of a corner stays as it is.
  const auto vertex_normals = attribute_of_vertices(mesh, mesh.normal_triangles, mesh.normals);
  const std::size_t before = mesh.positions.size();
  spatial::PointClusterDictionary<double, 3, std::uint32_t> kept(distance);
  std::vector<std::uint32_t> kept_of(before);
  std::vector<std::uint32_t> normal_of_kept;
  for (std::size_t v = 0; v < before; ++v) {
    const Eigen::Vector3d position = mesh.positions[v];
    const auto next = static_cast<std::uint32_t>(kept.size());
    const spatial::MergeResult merged =
        kept.insert_or_merge({position.x(), position.y(), position.z()}, next);
    if (!merged.cluster.valid())
      return Error{
          fmt::format("{}: the distance {} cannot be used: vertex {} is more than 2^30 times as far from "
                      "the origin, or the distance is out of range",
                      name, distance, v)};
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
