// Cuts of every kind: the hash of the hybrid mesh after the last one.
#include <cut/cutter.hpp>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <scenes/surfaces.hpp>

#include "hash.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

/// Cuts the cloth with one cutter after the other; 0 when one of the calls fails.
std::uint64_t after_cuts(const cut::TriangleMesh& cloth, const std::vector<cut::TriangleMesh>& cutters) {
  auto built = cut::HybridMesh::build(cloth);
  if (!built) return 0;
  cut::HybridMesh mesh = std::move(built).value();
  cut::Cutter cutter(cut::default_merge_distances(mesh));
  for (const cut::TriangleMesh& c : cutters)
    if (!cutter.cut(mesh, c)) return 0;
  return hashes::hash(mesh);
}

cut::TriangleMesh wall(const scenes::Path& path) { return scenes::ribbon(path, {0.05, 0.02, 3}); }

std::uint64_t progressive() {
  std::vector<cut::TriangleMesh> steps;
  const Vector3 from{-0.1, 0.31, 0};
  const Vector3 to{1.1, 0.64, 0};
  for (int i = 0; i < 40; ++i)
    steps.push_back(wall({from + (to - from) * i / 40, from + (to - from) * (i + 1) / 40}));
  return after_cuts(scenes::curved_sheet(20), steps);
}

std::uint64_t again_and_again() {
  std::vector<cut::TriangleMesh> cutters;
  for (int i = 0; i < 24; ++i) {
    const double a = (i * 7 % 24) / 6.0;
    const double b = (i * 11 % 24) / 6.0;
    cutters.push_back(wall({{a - 0.5, -1, 0}, {4.2 - b, 5, 0}}));
  }
  return after_cuts(scenes::random_sheet(4, 4, 1.0, 3), cutters);
}

const hashes::Case cases[]{
    {"cut/through", [] { return after_cuts(scenes::grid(6, 6), {wall({{-1, 1.3, 0}, {7, 4.6, 0}})}); }},
    {"cut/along_edges",
     [] { return after_cuts(scenes::grid(6, 6), {scenes::ribbon({{-1, 2, 0}, {7, 2, 0}}, {0, 0, 2})}); }},
    {"cut/cut_out",
     [] {
       return after_cuts(
           scenes::sphere(3),
           {scenes::tube(scenes::circle_path({0, 0, 0}, {0.5, 0, 0}, {0, 0.4, 0}, 24), {0, 0, 4})});
     }},
    {"cut/star",
     [] {
       return after_cuts(scenes::grid(6, 6),
                         {scenes::star({3.1, 2.9, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 2}, 5)});
     }},
    {"cut/e_shape",
     [] {
       return after_cuts(scenes::twelve_triangles(),
                         {scenes::e_shape({0.6, 0.2, 0}, {0, 1.2, 0}, {1.4, 0, 0}, {0, 0, 2})});
     }},
    {"cut/moebius",
     [] { return after_cuts(scenes::moebius_strip(24, 4), {wall({{-2, 0.1, 0}, {2, 0.3, 0}})}); }},
    {"cut/progressive", progressive},
    {"cut/again_and_again", again_and_again},
};

}  // namespace
