// CGAL compiles slowly: nothing else here includes it.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "cutting/measure.hpp"
#include "cutting/programs.hpp"

namespace cutting {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;

template <class Kernel>
using SurfaceMesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

template <class Kernel>
SurfaceMesh<Kernel> converted(const cut::TriangleMesh& mesh) {
  using Mesh = SurfaceMesh<Kernel>;
  Mesh result;
  result.reserve(mesh.positions.size(), mesh.positions.size() + mesh.triangles.size(), mesh.triangles.size());
  for (const Eigen::Vector3d& p : mesh.positions)
    result.add_vertex(typename Kernel::Point_3(p.x(), p.y(), p.z()));
  for (const auto& t : mesh.triangles)
    result.add_face(typename Mesh::Vertex_index(t[0]), typename Mesh::Vertex_index(t[1]),
                    typename Mesh::Vertex_index(t[2]));
  return result;
}

template <class Kernel>
cut::TriangleMesh converted_back(const SurfaceMesh<Kernel>& mesh) {
  cut::TriangleMesh result;
  std::vector<std::uint32_t> number(mesh.num_vertices() + mesh.number_of_removed_vertices());
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<std::uint32_t>(result.positions.size());
    const auto& p = mesh.point(v);
    result.positions.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[k++] = number[v];
    result.triangles.push_back(corners);
  }
  return result;
}

template <class Kernel>
void steps(const Progressive& experiment, StepsResult& result) {
  Stopwatch watch;
  SurfaceMesh<Kernel> mesh = converted<Kernel>(experiment.cloth);
  for (const cut::TriangleMesh& step : experiment.steps) {
    SurfaceMesh<Kernel> splitter = converted<Kernel>(step);
    watch.lap();
    processing::split(mesh, splitter);
    result.step_ms[result.steps_done++] = watch.lap();
  }
  auto component =
      mesh.template add_property_map<typename SurfaceMesh<Kernel>::Face_index, std::size_t>("f:component")
          .first;
  result.pieces = processing::connected_components(mesh, component);
}

template <class Kernel>
void once(const OneShot& experiment, OneShotResult& result) {
  Stopwatch watch;
  SurfaceMesh<Kernel> mesh = converted<Kernel>(experiment.cloth);
  SurfaceMesh<Kernel> splitter = converted<Kernel>(experiment.ribbon);
  result.prepare_ms = watch.lap();
  processing::split(mesh, splitter);
  result.cut_ms = watch.lap();
  describe(converted_back<Kernel>(mesh), result);
}

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

}  // namespace

void epick_steps(const Progressive& experiment, StepsResult& result) { steps<Epick>(experiment, result); }
void epeck_steps(const Progressive& experiment, StepsResult& result) { steps<Epeck>(experiment, result); }
void epick_once(const OneShot& experiment, OneShotResult& result) { once<Epick>(experiment, result); }
void epeck_once(const OneShot& experiment, OneShotResult& result) { once<Epeck>(experiment, result); }

}  // namespace cutting
