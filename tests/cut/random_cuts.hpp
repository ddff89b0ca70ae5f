/// @file
/// Random cut sequences on random cloths, decoded from a stream of bytes: one body for the property test and
/// the fuzz target.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cut/cutter.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/validate.hpp"
#include "provenance.hpp"
#include "scenes/cloths.hpp"
#include "scenes/cutters.hpp"
#include "scenes/surfaces.hpp"

namespace random_cuts {

/// Reads numbers from bytes; all of them are zero after the end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  /// One of `count` values.
  unsigned choice(unsigned count) { return byte() % count; }
  /// A number in [low, high]: of 16 coarse steps half of the time (so that cuts meet nodes, edges and each
  /// other exactly), else of 65536 fine ones.
  double number(double low, double high) {
    const unsigned first = byte();
    const double part =
        (first & 1u) != 0 ? (first >> 1u) % 17 / 16.0 : ((first >> 1u) * 256u + byte()) / 32767.0;
    return low + (high - low) * part;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

struct Cloth {
  cut::TriangleMesh mesh;
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

inline Cloth cloth(Bytes& bytes) {
  Cloth result;
  switch (bytes.choice(9)) {
    case 0:
      result.mesh = scenes::twelve_triangles();
      break;
    case 1:
      result.mesh = scenes::grid(3, 3, 1.0);
      break;
    case 2:
      result.mesh = scenes::grid(1, 1, 1.0);
      break;
    case 3:
      result.mesh = scenes::random_sheet(4, 4, 1.0, bytes.byte());
      break;
    case 4:
      result.mesh = scenes::sphere(1);
      break;
    case 5:
      result.mesh = scenes::torus(6, 4);
      break;
    case 6:
      result.mesh = scenes::cylinder(6, 3);
      break;
    case 7:
      result.mesh = scenes::moebius_strip(8, 2);
      break;
    default:
      result.mesh = scenes::fan(7);
      break;
  }
  result.low = result.high = result.mesh.positions[0];
  for (const auto& p : result.mesh.positions) {
    result.low = result.low.cwiseMin(p);
    result.high = result.high.cwiseMax(p);
  }
  return result;
}

inline Eigen::Vector3d point(Bytes& bytes, const Cloth& cloth) {
  const Eigen::Vector3d size = (cloth.high - cloth.low).cwiseMax(1.0);
  const Eigen::Vector3d low = cloth.low - size / 8;
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = bytes.number(low[k], low[k] + size[k] * 1.25);
  return p;
}

/// A cutter of a few triangles: a wall along a random path, a star through a point, a tube, a swept edge, or
/// any triangles.
inline cut::TriangleMesh cutter(Bytes& bytes, const Cloth& cloth) {
  const Eigen::Vector3d deep = Eigen::Vector3d::UnitZ() * (2 * (cloth.high - cloth.low).maxCoeff() + 2);
  const auto base = [&] { return point(bytes, cloth); };
  switch (bytes.choice(6)) {
    case 0:
      return scenes::ribbon({base(), base()}, deep);
    case 1: {
      scenes::Path path;
      const unsigned count = 2 + bytes.choice(5);
      for (unsigned i = 0; i < count; ++i) path.push_back(base());
      return scenes::ribbon(path, deep);
    }
    case 2: {
      const Eigen::Vector3d centre = base();
      scenes::Path path;
      const double radius = bytes.number(0.1, 2);
      return scenes::tube(scenes::circle_path(centre, Eigen::Vector3d::UnitX() * radius,
                                              Eigen::Vector3d::UnitY() * radius, 3 + bytes.choice(8)),
                          deep);
    }
    case 3: {
      const Eigen::Vector3d centre = base();
      const Eigen::Vector3d arm{bytes.number(0.5, 4), bytes.number(-1, 1), 0};
      std::vector<cut::TriangleMesh> arms;
      const unsigned count = 2 + bytes.choice(4);
      for (unsigned i = 0; i < count; ++i) {
        const double angle = i * 0.6;
        const Eigen::Vector3d d{arm.x() * (1 - angle) - arm.y() * angle,
                                arm.x() * angle + arm.y() * (1 - angle), 0};
        arms.push_back(scenes::ribbon({centre - d, centre + d}, deep));
      }
      return scenes::joined(arms);
    }
    case 4:
      return scenes::swept({point(bytes, cloth), point(bytes, cloth)},
                           {point(bytes, cloth), point(bytes, cloth)});
    default: {
      cut::TriangleMesh mesh;
      const unsigned count = 1 + bytes.choice(4);
      for (unsigned i = 0; i < 3 * count; ++i) mesh.positions.push_back(point(bytes, cloth));
      for (unsigned i = 0; i < count; ++i) mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      return mesh;
    }
  }
}

inline cut::MergeDistances distances(Bytes& bytes, const cut::HybridMesh& mesh) {
  cut::MergeDistances d = cut::default_merge_distances(mesh);
  switch (bytes.choice(5)) {
    case 0:
      d = {d.cut * 2, d.node * 2, d.edge * 2};
      break;
    case 1:
      d = {d.cut * 1e-2, d.node * 1e-2, d.edge * 1e-2};
      break;
    case 2:
      d = {d.cut * 1e-4, d.node * 1e-5, d.edge * 1e-5};
      break;
    case 3: {  // as small as they may be
      double longest = 0;
      for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e)
        longest = std::max(longest, mesh.ancestors.rest_length(cut::AncestorEdgeId{e}));
      const double units = bytes.number(1.1, 4);
      d.cut = d.node = d.edge = units * longest / cut::lattice_size;
      break;
    }
    default:
      break;
  }
  return d;
}

/// Runs the sequence that the bytes describe. @return what went wrong, empty when nothing did
inline std::string run(const std::uint8_t* data, std::size_t size, unsigned most_cuts = 30) {
  Bytes bytes(data, size);
  const Cloth input = cloth(bytes);
  auto built = cut::HybridMesh::build(input.mesh);
  if (!built) return "build: " + built.error().message;
  cut::HybridMesh mesh = std::move(built).value();
  cut::Cutter knife(distances(bytes, mesh));
  for (unsigned i = 0; i < most_cuts && !bytes.empty(); ++i) {
    if (bytes.choice(4) == 0) {  // the cloth moves
      for (auto& p : mesh.positions)
        p += Eigen::Vector3d(bytes.number(-0.1, 0.1), bytes.number(-0.1, 0.1), bytes.number(-0.3, 0.3));
      mesh.moved();
    }
    cut::Buffers copy = mesh.buffers;
    const auto bending = provenance::all_bending_pairs(mesh);
    const auto result = knife.cut(mesh, cutter(bytes, input));
    if (!result) return "cut " + std::to_string(i) + ": " + result.error().message;
    const cut::Changes back = cut::inverse(*result, copy);
    const cut::Buffers before = copy;
    if (const std::string fault = provenance::fault(*result, before, bending, mesh); !fault.empty())
      return "cut " + std::to_string(i) + ": " + fault;
    cut::apply(*result, copy);
    if (!(copy == mesh.buffers))
      return "cut " + std::to_string(i) + ": the change set does not give the new buffers";
    cut::apply(back, copy);
    if (!(copy == before)) return "cut " + std::to_string(i) + ": the inverse does not give the old buffers";
    for (const cut::Violation& v : cut::validate(mesh, 3))
      return "cut " + std::to_string(i) + ": " + v.rule + ": " + v.message;
  }
  return {};
}

}  // namespace random_cuts
