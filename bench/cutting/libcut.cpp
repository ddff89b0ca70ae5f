// The experiments with libcut (programs.hpp).
#include <cstdio>
#include <cstdlib>

#include "cut/cutter.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/pieces.hpp"
#include "cutting/measure.hpp"
#include "cutting/programs.hpp"

namespace cutting {
namespace {

/// The inputs are ours, so an error is a mistake in this program.
template <class T>
T must(cut::Result<T>&& result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "libcut: %s\n", result.error().message.c_str());
  std::exit(1);
}

cut::TriangleMesh render_triangles(const cut::HybridMesh& mesh) {
  cut::TriangleMesh result;
  for (const cut::RenderVertex& v : mesh.buffers.render_vertices)
    result.positions.push_back(v.triangle.valid() ? mesh.position(v) : Eigen::Vector3d::Zero());
  for (const cut::RenderTriangle& t : mesh.buffers.render_triangles)
    if (t.triangle.valid())
      result.triangles.push_back({t.vertices[0].value, t.vertices[1].value, t.vertices[2].value});
  return result;
}

cut::TriangleMesh physics_triangles(const cut::HybridMesh& mesh) {
  cut::TriangleMesh result;
  result.positions = mesh.positions;
  for (const cut::PhysicsTriangle& t : mesh.buffers.triangles)
    if (t.ancestor.valid())
      result.triangles.push_back({t.nodes[0].value, t.nodes[1].value, t.nodes[2].value});
  return result;
}

}  // namespace

void libcut_steps(const Progressive& experiment, StepsResult& result) {
  Stopwatch watch;
  cut::HybridMesh mesh = must(cut::HybridMesh::build(experiment.cloth));
  cut::Cutter cutter(cut::default_merge_distances(mesh));
  for (const cut::TriangleMesh& step : experiment.steps) {
    watch.lap();
    const cut::Changes changes = must(cutter.cut(mesh, step));
    result.step_ms[result.steps_done++] = watch.lap();
  }
  result.pieces = cut::pieces(mesh).list.size();
}

void libcut_once(const OneShot& experiment, OneShotResult& result) {
  Stopwatch watch;
  cut::HybridMesh mesh = must(cut::HybridMesh::build(experiment.cloth));
  result.prepare_ms = watch.lap();
  {
    cut::Cutter cutter(cut::default_merge_distances(mesh));
    const cut::Changes changes = must(cutter.cut(mesh, experiment.ribbon));
    result.cut_ms = watch.lap();
    result.peak_mebibytes = peak_mebibytes();
  }
  const cut::TriangleMesh physics = physics_triangles(mesh);
  const cut::TriangleMesh render = render_triangles(mesh);
  result.pieces = cut::pieces(mesh).list.size();
  result.render_triangles = render.triangles.size();
  result.physics_triangles = physics.triangles.size();
  result.smallest_render_angle = smallest_angle(render);
  result.smallest_physics_angle = smallest_angle(physics);
}

}  // namespace cutting
