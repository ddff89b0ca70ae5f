// Types of others are used as they are: Eigen's, Boost.Geometry's, and a user's own.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <spatial/adapt/boost_geometry.hpp>
#include <spatial/adapt/eigen.hpp>
#include <spatial/bounding_box_ternary_tree.hpp>

namespace own {

struct Circle {
  float x, y, radius;
  bool operator==(const Circle&) const = default;
};

}  // namespace own

template <>
struct spatial::GeometryTraits<own::Circle> {
  using Scalar = float;
  static constexpr std::size_t dimension = 2;
  static float min(const own::Circle& c, std::size_t axis) { return (axis == 0 ? c.x : c.y) - c.radius; }
  static float max(const own::Circle& c, std::size_t axis) { return (axis == 0 ? c.x : c.y) + c.radius; }
};

TEST_CASE("Eigen's boxes and vectors") {
  spatial::BoundingBoxTernaryTree<int, double, 3> tree;
  tree.insert(Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3)), 1);
  tree.insert(Eigen::Vector3d(5, 5, 5), 2);
  tree.insert(Eigen::Vector3f(6, 6, 6), 3);  // float to double loses nothing
  CHECK_FALSE(tree.insert(Eigen::AlignedBox3d(), 4).valid());
  CHECK(tree.count(spatial::intersects(Eigen::Vector3d(1, 2, 3))) == 1);
  CHECK(tree.bounds().max == spatial::Point<double, 3>{6, 6, 6});
  int found = 0;
  tree.query(spatial::nearest(Eigen::Vector3d(4, 4, 4), 1), [&](int v) { found = v; });
  CHECK(found == 2);
}

TEST_CASE("Boost.Geometry's boxes and points") {
  namespace bg = boost::geometry;
  using Point = bg::model::point<float, 2, bg::cs::cartesian>;
  using Box = bg::model::box<Point>;
  spatial::BoundingBoxTernaryTree<std::pair<Box, int>, float, 2> tree;
  tree.insert(std::pair{Box({0, 1}, {2, 3}), 1});
  CHECK(tree.count(spatial::covers(bg::model::d2::point_xy<float>(2, 3))) == 1);
  CHECK(tree.count(spatial::intersects(Box({2.5, 0}, {3, 9}))) == 0);
}

TEST_CASE("a type of one's own") {
  spatial::BoundingBoxTernaryTree<own::Circle, float, 2> tree;
  for (int i = 0; i < 100; ++i) tree.insert(own::Circle{float(i), 0, 0.5f});
  CHECK(tree.count(spatial::intersects(own::Circle{50, 0.5f, 0.25f})) == 1);
  CHECK(tree.contains(own::Circle{99, 0, 0.5f}));
}
