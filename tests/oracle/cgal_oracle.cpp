// CGAL compiles slowly: nothing but this file includes it.
#include "oracle/cgal_oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace oracle {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh converted(const cut::TriangleMesh& mesh) {
  Mesh result;
  for (const Eigen::Vector3d& p : mesh.positions) result.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  for (const auto& t : mesh.triangles)
    result.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  return result;
}

double area(const Mesh& mesh, Mesh::Face_index face) {
  std::vector<Eigen::Vector3d> p;
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) {
    const Kernel::Point_3& q = mesh.point(v);
    p.emplace_back(CGAL::to_double(q.x()), CGAL::to_double(q.y()), CGAL::to_double(q.z()));
  }
  return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
}

}  // namespace

std::vector<double> split_pieces(const cut::TriangleMesh& cloth,
                                 const std::vector<cut::TriangleMesh>& cutters) {
  namespace processing = CGAL::Polygon_mesh_processing;
  Mesh mesh = converted(cloth);
  // Not `split`: the two lips of a slit that it opens lie on each other, and a mesh that touches itself must
  // not be given to it again. Here the cuts stay marked edges.
  const auto is_cut = mesh.add_property_map<Mesh::Edge_index, bool>("e:cut", false).first;
  const auto with_cuts = CGAL::parameters::edge_is_constrained_map(is_cut);
  for (const cut::TriangleMesh& cutter : cutters) {
    Mesh splitter = converted(cutter);
    processing::corefine(mesh, splitter, with_cuts);
  }
  const auto component = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:component").first;
  std::vector<double> areas(processing::connected_components(mesh, component, with_cuts), 0);
  for (const Mesh::Face_index f : mesh.faces()) areas[component[f]] += area(mesh, f);
  std::sort(areas.rbegin(), areas.rend());
  return areas;
}

}  // namespace oracle
