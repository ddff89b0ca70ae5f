// Ends of lines merge across the borders of triangles (§7): two slits that meet within δn become one cut
// wherever the border runs between them.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "cut/pieces.hpp"
#include "cut_and_check.hpp"
#include "scenes/cutters.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

/// Triangles around a point, so large that no other border is near it.
cut::TriangleMesh fan(const Vector3& centre, std::size_t triangles) {
  cut::TriangleMesh mesh{{centre}, {}};
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const double angle = 0.3 + 6.283185307179586 * i / static_cast<double>(triangles);
    mesh.positions.push_back({9 * std::cos(angle), 9 * std::sin(angle), 0});
    const auto next = static_cast<std::uint32_t>((i + 1) % triangles);
    mesh.triangles.push_back({0, i + 1, next + 1});
  }
  return mesh;
}

/// Two triangles whose common edge passes the origin at `distance`, in the direction `angle`.
cut::TriangleMesh halves(double distance, double angle) {
  const Vector3 along(-std::sin(angle), std::cos(angle), 0);
  const Vector3 across(std::cos(angle), std::sin(angle), 0);
  return {{distance * across - 9 * along, distance * across + 9 * along, -12 * across, 12 * across},
          {{0, 1, 2}, {1, 0, 3}}};
}

struct Random {
  std::mt19937 engine{20261126};
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
  }
};

/// A slit from far away to a point near the origin.
cut::TriangleMesh slit(double from_angle, const Vector3& to) {
  return scenes::ribbon({Vector3(14 * std::cos(from_angle), 14 * std::sin(from_angle), 0), to}, {0, 0, 2});
}

/// Two slits, from anywhere, whose ends are less than δn apart.
struct Meeting {
  Vector3 first;
  Vector3 second;
  double from_first;
  double from_second;

  Meeting(Random& random, double node_distance)
      : first(random.between(-0.1, 0.1), random.between(-0.1, 0.1), 0),
        from_first(random.between(0, 6.283185307179586)),
        from_second(from_first + random.between(2, 4)) {
    const double direction = random.between(0, 6.283185307179586);
    const double gap = random.between(0.01, 0.95) * node_distance;
    second = first + gap * Vector3(std::cos(direction), std::sin(direction), 0);
  }
};

cut::TriangleMesh near_edge(Random& random) {
  return halves(random.between(-0.25, 0.25), random.between(0, 3.141592653589793));
}

cut::TriangleMesh near_node(Random& random) {
  const Vector3 node(random.between(-0.2, 0.2), random.between(-0.2, 0.2), 0);
  return fan(node, 3 + static_cast<std::size_t>(random.between(0, 5)));
}

/// The number of times, of 500, that two slits whose ends are within δn do not become one.
template <class Cloth>
int broken_cuts(const cut::MergeDistances& distances, const Cloth& cloth, bool at_once) {
  Random random;
  int broken = 0;
  for (int i = 0; i < 500; ++i) {
    const Meeting m(random, distances.node);
    const cut::TriangleMesh first = slit(m.from_first, m.first), second = slit(m.from_second, m.second);
    Session s(cloth(random), distances);
    if (at_once) {
      s.cut(scenes::joined({first, second}));
    } else {
      s.cut(first);
      REQUIRE(cut::pieces(s.mesh).list.size() == 1);
      s.cut(second);
    }
    if (cut::pieces(s.mesh).list.size() != 2) ++broken;
  }
  return broken;
}

TEST_CASE("a cut meets its end, wherever a border or a node lies") {
  for (const cut::MergeDistances distances : {cut::MergeDistances{0.2, 0.1, 0.05}, {0.2, 0.1, 0.01}}) {
    CAPTURE(distances.edge);
    CHECK(broken_cuts(distances, near_edge, false) == 0);
    CHECK(broken_cuts(distances, near_node, false) == 0);
  }
}

TEST_CASE("two slits of one cut meet, whatever attracts one of their ends") {
  const auto far_edge = [](Random&) { return halves(3, 0); };
  for (const double edge_distance : {0.001, 0.01, 0.05}) {
    const cut::MergeDistances distances{0.2, 0.1, edge_distance};
    CAPTURE(edge_distance);
    CHECK(broken_cuts(distances, near_edge, true) == 0);
    CHECK(broken_cuts(distances, near_node, true) == 0);
    CHECK(broken_cuts(distances, far_edge, true) == 0);
  }
}

/// Ends of two slits on both sides of an edge, the one that comes from the left at (-left, 0).
struct Pair {
  double left;
  double right;
  double up;
  bool near;  ///< within δn

  Pair(Random& random, double least_left, double least_right, const cut::MergeDistances& distances)
      : left(random.between(least_left, 0.09)),
        right(random.between(least_right, 0.09)),
        up(random.between(-0.1, 0.1)),
        near(std::hypot(left + right, up) < distances.node) {}
  [[nodiscard]] cut::TriangleMesh from_left() const { return slit(3.1, {-left, 0, 0}); }
  [[nodiscard]] cut::TriangleMesh from_right() const { return slit(0.1, {right, up, 0}); }
};

TEST_CASE("two ends of one cut meet across a border from as far as within a triangle") {
  constexpr cut::MergeDistances distances{0.2, 0.1, 0.001};
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Pair ends(random, 0.002, 0.002, distances);
    Session s(halves(0, 0), distances);
    s.cut(scenes::joined({ends.from_left(), ends.from_right()}));
    CAPTURE(ends.left);
    CAPTURE(ends.right);
    CAPTURE(ends.up);
    CHECK(cut::pieces(s.mesh).list.size() == (ends.near ? 2 : 1));
  }
}

TEST_CASE("an end sees a node across an edge from as far as one on its own side") {
  constexpr cut::MergeDistances distances{0.2, 0.1, 0.01};
  Random random;
  for (int i = 0; i < 500; ++i) {
    // The first slit ends inside of the left triangle, and nothing is near enough to attract its end.
    const Pair ends(random, 0.011, 0.001, distances);
    Session s(halves(0, 0), distances);
    s.cut(ends.from_left());
    s.cutter = cut::Cutter(distances);  // knows of no end
    s.cut(ends.from_right());
    CAPTURE(ends.left);
    CAPTURE(ends.right);
    CAPTURE(ends.up);
    if (ends.near) CHECK(cut::pieces(s.mesh).list.size() == 2);
    // On the edge the end may have been led to it by up to δe, and so come within δn.
    if (ends.right > distances.edge && !ends.near) CHECK(cut::pieces(s.mesh).list.size() == 1);
  }
}

TEST_CASE("an end does not see across an edge that is cut") {
  constexpr cut::MergeDistances distances{0.2, 0.1, 0.01};
  for (const bool open : {false, true}) {
    Session s(halves(0, 0), distances);
    s.cut(slit(3.1, {-0.03, 0, 0}));
    if (open) s.cut(scenes::ribbon({{0, -1, 0}, {0, 1, 0}}, {0, 0, 2}));
    s.cutter = cut::Cutter(distances);
    const cut::AncestorId left{0};
    const std::size_t edges = s.mesh.arrangement(left)->edges.size();
    s.cut(slit(0.0, {0.03, 0.05, 0}));
    CHECK(s.mesh.arrangement(left)->edges.size() == edges + (open ? 0 : 1));
  }
}

}  // namespace
