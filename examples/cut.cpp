#include <cstdio>
#include <cut/cutter.hpp>
#include <cut/pieces.hpp>
#include <cut/simulation.hpp>

int main() {
  const cut::TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const cut::TriangleMesh blade{{{0.3, -1, -1}, {0.4, 2, -1}, {0.35, 0.5, 3}}, {{0, 1, 2}}};
  auto mesh = cut::HybridMesh::build(sheet);
  auto simulation = cut::Simulation::build(*mesh, cut::Material{});
  simulation->surroundings.gravity = {0, 0, -9.81};
  simulation->anchor(cut::NodeId{0});
  cut::Cutter cutter(cut::default_merge_distances(*mesh));
  const auto changes = cutter.cut(*mesh, blade);
  if (const auto error = simulation->apply(*changes, *mesh)) return std::puts(error->message.c_str());
  if (const auto error = simulation->step(*mesh, 0.001, 100)) return std::puts(error->message.c_str());
  for (const cut::Piece& p : cut::pieces(*mesh).list)
    std::printf("area %.3f, %zu render triangles\n", p.rest_area, p.triangles);
}
