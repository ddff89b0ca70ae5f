// The result does not depend on the order of cutter triangles, of physics triangles and nodes, nor on how the
// cutter is divided; the same cut twice does nothing; many small steps give the same pieces as one big one;
// moving everything gives the same pieces (docs/cutting.md, "Why in this order").
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cut/pieces.hpp"
#include "cut_and_check.hpp"
#include "places.hpp"
#include "random_cuts.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

std::vector<double> areas(const cut::HybridMesh& mesh) {
  std::vector<double> result;
  for (const cut::Piece& p : cut::pieces(mesh).list) result.push_back(p.rest_area);
  std::sort(result.begin(), result.end());
  return result;
}

/// Length of all cuts, at rest.
double cut_length(const cut::HybridMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const cut::Arrangement* arrangement = mesh.arrangement(cut::AncestorId{t});
    if (arrangement == nullptr) continue;
    const auto rest = rest_corners(mesh, cut::AncestorId{t});
    const auto place = [&](std::uint32_t node) { return interpolated(rest, arrangement->nodes[node].point); };
    for (const cut::CutEdge& e : arrangement->edges) sum += (place(e.to) - place(e.from)).norm();
  }
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e) {
    const cut::EdgeState* state = mesh.edge_state(cut::AncestorEdgeId{e});
    for (std::size_t k = 0; state != nullptr && k < state->cut.size(); ++k) {
      const std::int32_t from = k == 0 ? 0 : state->nodes[k - 1].t;
      const std::int32_t to = k == state->nodes.size() ? cut::lattice_size : state->nodes[k].t;
      if (state->cut[k] != 0)
        sum += mesh.ancestors.rest_length(cut::AncestorEdgeId{e}) * ((to - from) / 0x1p25);
    }
  }
  return sum;
}

void check_same_areas(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::abs(a[i] - b[i]) <= tolerance);
}

bool same_state(const cut::HybridMesh& a, const cut::HybridMesh& b) {
  return a.buffers == b.buffers && a.arrangements == b.arrangements && a.edge_states == b.edge_states &&
         a.arrangement_of == b.arrangement_of && a.edge_state_of == b.edge_state_of;
}

std::vector<std::uint32_t> shuffled(std::size_t count, std::uint32_t seed) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i) {
    seed = seed * 1664525u + 1013904223u;
    std::swap(order[i - 1], order[(seed >> 8) % i]);
  }
  return order;
}

cut::TriangleMesh with_triangles_shuffled(const cut::TriangleMesh& mesh, std::uint32_t seed) {
  cut::TriangleMesh result{mesh.positions, {}};
  for (const std::uint32_t t : shuffled(mesh.triangles.size(), seed)) {
    auto corners = mesh.triangles[t];
    std::rotate(corners.begin(), corners.begin() + t % 3, corners.end());
    result.triangles.push_back(corners);
  }
  return result;
}

cut::TriangleMesh with_nodes_shuffled(const cut::TriangleMesh& mesh, std::uint32_t seed) {
  const auto order = shuffled(mesh.positions.size(), seed);
  std::vector<std::uint32_t> place(order.size());
  cut::TriangleMesh result;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    result.positions.push_back(mesh.positions[order[i]]);
  }
  for (auto t : mesh.triangles) {
    for (auto& corner : t) corner = place[corner];
    result.triangles.push_back(t);
  }
  return result;
}

/// Every triangle in four.
cut::TriangleMesh divided(const cut::TriangleMesh& mesh) {
  cut::TriangleMesh result;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const auto n = static_cast<std::uint32_t>(result.positions.size());
    for (const Vector3& p : {a, b, c, Vector3((a + b) / 2), Vector3((b + c) / 2), Vector3((c + a) / 2)})
      result.positions.push_back(p);
    result.triangles.push_back({n, n + 3, n + 5});
    result.triangles.push_back({n + 3, n + 1, n + 4});
    result.triangles.push_back({n + 5, n + 4, n + 2});
    result.triangles.push_back({n + 3, n + 4, n + 5});
  }
  return result;
}

cut::TriangleMesh wall(const scenes::Path& path) { return scenes::ribbon(path, {0, 0, 2}); }

TEST_CASE("any order of the cutter's triangles gives the same bits") {
  CHECK(rc::check([](const std::vector<std::uint8_t>& data, std::uint32_t seed) {
    random_cuts::Bytes bytes(data.data(), data.size());
    const random_cuts::Cloth cloth = random_cuts::cloth(bytes);
    Session one(cloth.mesh);
    Session other(cloth.mesh);
    for (int i = 0; i < 4; ++i) {
      const cut::TriangleMesh cutter = random_cuts::cutter(bytes, cloth);
      one.cut(cutter);
      other.cut(with_triangles_shuffled(cutter, seed));
      RC_ASSERT(same_state(one.mesh, other.mesh));
    }
  }));
}

TEST_CASE("any order of the cloth's triangles and nodes gives the same pieces to the bit") {
  CHECK(rc::check([](const std::vector<std::uint8_t>& data, std::uint32_t seed) {
    random_cuts::Bytes bytes(data.data(), data.size());
    random_cuts::Cloth cloth = random_cuts::cloth(bytes);
    Session one(cloth.mesh);
    Session other(with_nodes_shuffled(with_triangles_shuffled(cloth.mesh, seed), seed + 1));
    for (int i = 0; i < 4; ++i) {
      const cut::TriangleMesh cutter = random_cuts::cutter(bytes, cloth);
      one.cut(cutter);
      other.cut(cutter);
      RC_ASSERT(areas(one.mesh).size() == areas(other.mesh).size());
      // All points of both render meshes, without their order.
      const auto points = [](const cut::HybridMesh& mesh) {
        std::vector<std::array<double, 3>> list;
        for (const cut::RenderVertex& v : mesh.buffers.render_vertices) {
          if (!v.triangle.valid()) continue;
          std::array<std::array<double, 4>, 3> terms;  // weight and position, in an order of their own
          for (std::size_t k = 0; k < 3; ++k) {
            const Vector3& p = mesh.positions[v.nodes[k].index()];
            terms[k] = {static_cast<double>(v.point[k]), p.x(), p.y(), p.z()};
          }
          std::sort(terms.begin(), terms.end());
          std::array<double, 3> sum{};
          for (const auto& t : terms)
            if (t[0] != 0)
              for (std::size_t k = 0; k < 3; ++k) sum[k] += t[0] * t[k + 1];
          list.push_back(sum);
        }
        std::sort(list.begin(), list.end());
        return list;
      };
      RC_ASSERT(points(one.mesh) == points(other.mesh));
    }
  }));
}

TEST_CASE("dividing a cutter's triangles does not change the pieces") {
  const scenes::Path path{{-1, 0.37, 0}, {1.9, 1.13, 0}, {2.6, 3.1, 0}, {5, 3.3, 0}};
  for (const auto& cloth : {scenes::grid(4, 4), scenes::random_sheet(4, 4, 1.0, 3)}) {
    Session whole(cloth);
    Session parts(cloth);
    whole.cut(wall(path));
    parts.cut(divided(divided(wall(path))));
    check_same_areas(areas(whole.mesh), areas(parts.mesh), 1e-6);
  }
}

std::vector<std::uint8_t> bytes_of(std::uint32_t seed, std::size_t count) {
  std::vector<std::uint8_t> data(count);
  std::uint32_t state = seed * 2654435761u;
  for (auto& byte : data) {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  return data;
}

TEST_CASE("the same cut twice changes nothing, random near misses of nodes included") {
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    const auto data = bytes_of(seed, 60);
    random_cuts::Bytes bytes(data.data(), data.size());
    const random_cuts::Cloth cloth = random_cuts::cloth(bytes);
    Session s(cloth.mesh);
    for (int i = 0; i < 3; ++i) {
      const cut::TriangleMesh cutter = random_cuts::cutter(bytes, cloth);
      s.cut(cutter);
      const cut::Buffers once = s.mesh.buffers;
      const cut::Changes again = s.cut(cutter);
      CHECK(again.empty());
      CHECK(s.mesh.buffers == once);
    }
  }
}

TEST_CASE("a cut made again beside a new one adds nothing: its ends find the nodes that they went to") {
  // §7, "additional cluster center": of 40,000 random pairs of cutters those that come out otherwise without.
  for (const std::uint32_t seed : {1181u, 35889u}) {
    const auto data = bytes_of(seed, 80);
    random_cuts::Bytes bytes(data.data(), data.size());
    const random_cuts::Cloth cloth = random_cuts::cloth(bytes);
    const cut::HybridMesh mesh = *cut::HybridMesh::build(cloth.mesh);
    const cut::MergeDistances distances = random_cuts::distances(bytes, mesh);
    const cut::TriangleMesh first = random_cuts::cutter(bytes, cloth);
    const cut::TriangleMesh second = random_cuts::cutter(bytes, cloth);
    Session alone(cloth.mesh, distances);
    Session again(cloth.mesh, distances);
    alone.cut(first);
    alone.cut(second);
    again.cut(first);
    again.cut(scenes::joined({first, second}));
    CHECK(cut::pieces(again.mesh).list.size() == cut::pieces(alone.mesh).list.size());
  }
}

TEST_CASE("many small steps give the same pieces as one cut") {
  for (const int steps : {3, 10, 57, 400}) {
    Session once(scenes::grid(4, 4));
    Session often(scenes::grid(4, 4));
    const Vector3 from{-0.7, 0.83, 0};
    const Vector3 to{4.6, 3.27, 0};
    once.cut(wall({from, to}));
    for (int i = 0; i < steps; ++i)
      often.cut(wall({from + (to - from) * i / steps, from + (to - from) * (i + 1) / steps}));
    check_same_areas(areas(once.mesh), areas(often.mesh), 0.12);
  }
}

TEST_CASE("a blade that begins inside of a triangle cuts however small its steps") {
  const Vector3 from{0.61, 0.83, 0};
  const Vector3 to{3.32, 3.07, 0};
  for (const int steps : {1, 10, 57, 400, 3000}) {
    CAPTURE(steps);
    Session s(scenes::grid(4, 4));
    for (int i = 0; i < steps; ++i)
      s.cut(wall({from + (to - from) * i / steps, from + (to - from) * (i + 1) / steps}));
    CHECK(cut_length(s.mesh) == doctest::Approx((to - from).norm()).epsilon(0.06));
    const auto pieces = cut::pieces(s.mesh).list;
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].boundary_loops == 2);  // a slit that reaches no border
  }
}

TEST_CASE("moving cloth and cutter together does not change the pieces") {
  const scenes::Path path{{-1, 0.37, 0}, {1.9, 1.13, 0}, {2.6, 3.1, 0}, {5, 3.3, 0}};
  Session still(scenes::random_sheet(4, 4, 1.0, 5));
  still.cut(wall(path));
  for (const double angle : {0.3, 1.1, 2.9}) {
    Eigen::Matrix3d turn;
    const double c = std::cos(angle), s = std::sin(angle);
    turn << c, -s, 0, s, c, 0, 0, 0, 1;
    Eigen::Matrix3d tilt;
    tilt << 1, 0, 0, 0, c, -s, 0, s, c;
    const Eigen::Matrix3d rotation = turn * tilt;
    const auto moved = [&](cut::TriangleMesh mesh) {
      for (Vector3& p : mesh.positions) p = rotation * p + Vector3(10, -20, 30);
      return mesh;
    };
    Session other(moved(scenes::random_sheet(4, 4, 1.0, 5)));
    other.cut(moved(wall(path)));
    // Which of two points within δn of each other becomes the node follows their order in space, and so does
    // which node of a nearly straight chain is dropped first: the contour may differ by less than δe.
    check_same_areas(areas(still.mesh), areas(other.mesh), still.cutter.distances().edge * 0.1);
  }
}

}  // namespace
