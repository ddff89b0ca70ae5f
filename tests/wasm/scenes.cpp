// The generated cloths and cutters, and the hybrid meshes of the uncut cloths: where these differ, so does
// all that follows.
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <scenes/surfaces.hpp>

#include "hash.hpp"

namespace {

std::uint64_t built(const cut::TriangleMesh& cloth) {
  const auto mesh = cut::HybridMesh::build(cloth);
  return mesh ? hashes::hash(*mesh) : 0;
}

const hashes::Case cases[]{
    {"scene/twelve_triangles", [] { return hashes::hash(scenes::twelve_triangles()); }},
    {"scene/random_sheet", [] { return hashes::hash(scenes::random_sheet(20, 15, 0.1, 7)); }},
    {"scene/curved_sheet", [] { return hashes::hash(scenes::curved_sheet(20)); }},
    {"scene/sphere", [] { return hashes::hash(scenes::sphere(3)); }},
    {"scene/torus", [] { return hashes::hash(scenes::torus(24, 12)); }},
    {"scene/moebius_strip", [] { return hashes::hash(scenes::moebius_strip(24, 4)); }},
    {"scene/e_shape",
     [] { return hashes::hash(scenes::e_shape({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1})); }},
    {"build/random_sheet", [] { return built(scenes::random_sheet(20, 15, 0.1, 7)); }},
    {"build/sphere", [] { return built(scenes::sphere(3)); }},
    {"build/torus", [] { return built(scenes::torus(24, 12)); }},
};

}  // namespace
