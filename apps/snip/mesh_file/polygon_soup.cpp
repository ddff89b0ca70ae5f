// From polygons to triangles; see the header.
#include "snip/mesh_file/polygon_soup.hpp"

#include <utility>

#include "snip/mesh_file/scan.hpp"
#include "snip/mesh_file/triangulate.hpp"

namespace snip {

Mesh to_mesh(PolygonSoup soup) {
  const std::size_t corners = soup.corner_positions.size();
  if (soup.positions.size() >= no_index || corners >= no_index || soup.uvs.size() >= no_index ||
      soup.normals.size() >= no_index || soup.polygon_ends.size() >= no_index)
    scan::fail("the mesh is too large: at most {} points and corners are supported", no_index - 1);

  Mesh mesh;
  mesh.polygon_count = soup.polygon_ends.size();
  std::vector<Eigen::Vector3d> polygon;
  std::vector<Triangle> local;
  std::size_t begin = 0;
  for (std::size_t p = 0; p < soup.polygon_ends.size(); ++p) {
    const std::size_t end = soup.polygon_ends[p];
    if (end - begin > max_polygon_corners)
      scan::fail("polygon {} has {} corners, at most {} are supported: triangulate it first", p + 1,
                 end - begin, max_polygon_corners);
    polygon.clear();
    for (std::size_t c = begin; c < end; ++c) polygon.push_back(soup.positions[soup.corner_positions[c]]);
    local.clear();
    triangulate_polygon(polygon, local);
    for (const Triangle& triangle : local) {
      const auto pick = [&](const std::vector<std::uint32_t>& corner_values) -> Triangle {
        return {corner_values[begin + triangle[0]], corner_values[begin + triangle[1]],
                corner_values[begin + triangle[2]]};
      };
      mesh.triangles.push_back(pick(soup.corner_positions));
      mesh.polygon_of_triangle.push_back(static_cast<std::uint32_t>(p));
      if (!soup.corner_uvs.empty()) mesh.uv_triangles.push_back(pick(soup.corner_uvs));
      if (!soup.corner_normals.empty()) mesh.normal_triangles.push_back(pick(soup.corner_normals));
    }
    begin = end;
  }
  mesh.positions = std::move(soup.positions);
  mesh.uvs = std::move(soup.uvs);
  mesh.normals = std::move(soup.normals);
  mesh.colours = std::move(soup.colours);
  return mesh;
}

}  // namespace snip
