// Camera and drawing: what is seen where, in which light.
#include <doctest/doctest.h>

#include <cmath>
#include <ostream>

#include "snip/render/drawing.hpp"

using Eigen::Vector3d;
using snip::Camera;
using snip::Colour;
using snip::Drawing;
using snip::Image;
using snip::ScreenPoint;
using snip::View;

namespace snip {
std::ostream& operator<<(std::ostream& out, Colour c) {
  return out << int{c.r} << ' ' << int{c.g} << ' ' << int{c.b};
}
}  // namespace snip

namespace {

const Eigen::AlignedBox3d unit_box(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
constexpr Colour white{255, 255, 255};

Drawing square(Colour colour, double z) {
  Drawing drawing;
  drawing.surface.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
  drawing.surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  drawing.surface.colours = {colour, colour};
  return drawing;
}

}  // namespace

TEST_CASE("the box fits into the picture with a margin, seen from anywhere") {
  for (const double field : {0.0, 10.0, 90.0})
    for (const auto& direction :
         {Vector3d(0, 0, -1), Vector3d(1, 2, -3), Vector3d(-1, 0, 0), Vector3d(0, -5, 0)}) {
      const Camera camera({direction, {0, 1, 0}, field}, unit_box, 200, 100);
      Eigen::AlignedBox2d seen;
      for (int i = 0; i < 8; ++i) {
        const Vector3d corner =
            camera.to_view(unit_box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
        CHECK(corner.z() > camera.near_limit());
        const ScreenPoint p = camera.to_screen(corner);
        seen.extend(Eigen::Vector2d(p.x, p.y));
      }
      CHECK(seen.center().isApprox(Eigen::Vector2d(100, 50)));
      CHECK(seen.sizes().cwiseQuotient(Eigen::Vector2d(180, 90)).maxCoeff() == doctest::Approx(1));
    }
}

TEST_CASE("right is right, up is up, near is near") {
  for (const double field : {0.0, 40.0}) {
    const Camera camera({{0, 0, -1}, {0, 1, 0}, field}, unit_box, 100, 100);
    const auto at = [&](const Vector3d& p) { return camera.to_screen(camera.to_view(p)); };
    CHECK(at({1, 0, 0}).x > at({0, 0, 0}).x);
    CHECK(at({0, 1, 0}).y < at({0, 0, 0}).y);
    CHECK(at({0, 0, 1}).nearness > at({0, 0, 0}).nearness);
    CHECK(camera.to_screen(camera.lifted(camera.to_view({0, 0, 0}))).nearness > at({0, 0, 0}).nearness);
    CHECK(camera.to_screen(camera.lifted(camera.to_view({1, 1, 0}))).x == doctest::Approx(at({1, 1, 0}).x));
  }
}

TEST_CASE("a point, a line, and a direction along up can be looked at") {
  const Eigen::AlignedBox3d point(Vector3d(3, 3, 3), Vector3d(3, 3, 3)),
      line(Vector3d(0, 0, 0), Vector3d(0, 0, 2));
  for (const auto& box : {point, line})
    for (const double field : {0.0, 30.0}) {
      const Camera camera({{0, 0, -1}, {0, 0, 1}, field}, box, 80, 60);
      const ScreenPoint p = camera.to_screen(camera.to_view(box.center()));
      CHECK(p.x == doctest::Approx(40));
      CHECK(p.y == doctest::Approx(30));
      CHECK(std::isfinite(p.nearness));
    }
}

TEST_CASE("a square seen from the front fills its place; from behind it is darker") {
  const Colour yellow = snip::piece_colour(0);
  const Drawing drawing = square(yellow, 0.5);
  const Image front = draw(drawing, Camera({{0, 0, -1}, {0, 1, 0}, 0}, unit_box, 100, 100), 100, 100);
  const Image back = draw(drawing, Camera({{0, 0, 1}, {0, 1, 0}, 0}, unit_box, 100, 100), 100, 100);
  CHECK(front.at(3, 50) == white);
  CHECK(front.at(96, 50) == white);
  for (const std::size_t i : {6u, 50u, 93u}) {
    CHECK(front.at(i, i) == yellow);
    CHECK(back.at(i, i) == Colour{197, 179, 120});
  }
}

TEST_CASE("a steep face is darker than one that faces the viewer") {
  Drawing drawing = square(white, 0);
  drawing.surface.positions[2].z() = drawing.surface.positions[3].z() = -4;
  const Camera camera({{0, 0, -1}, {0, 1, 0}, 0}, unit_box, 100, 100);
  const Colour steep = draw(drawing, camera, 100, 100).at(50, 50);
  CHECK(steep.r < 230);
  CHECK(steep.r > 114);
}

TEST_CASE("lines on a face are seen, lines behind it are not, dots lie on lines, panes tint all") {
  Drawing drawing = square(snip::piece_colour(0), 0.5);
  constexpr Colour green{0, 128, 0}, red{255, 0, 0}, black{0, 0, 0};
  drawing.lines.push_back({{0, 0.5, 0.5}, {1, 0.5, 0.5}, green, 4});
  drawing.lines.push_back({{0, 0.2, 0.4}, {1, 0.2, 0.4}, red, 4});
  drawing.lines.push_back({{0, 0.8, 0.6}, {1, 0.8, 0.6}, red, 4});
  drawing.dots.push_back({{0.5, 0.5, 0.5}, black, 10});
  drawing.panes.push_back({{Vector3d(0.6, -9, 0.9), {9, -9, 0.9}, {0.6, 99, 0.9}}, red, 0.5});
  for (const double field : {0.0, 30.0}) {
    const Camera camera({{0, 0, -1}, {0, 1, 0}, field}, unit_box, 200, 200);
    const Image image = draw(drawing, camera, 200, 200);
    const auto at = [&](const Vector3d& p) {
      const ScreenPoint s = camera.to_screen(camera.to_view(p));
      return image.at(static_cast<std::size_t>(s.x), static_cast<std::size_t>(s.y));
    };
    CHECK(at({0.25, 0.5, 0.5}) == green);
    CHECK(at({0.25, 0.2, 0.4}) == snip::piece_colour(0));
    CHECK(at({0.25, 0.8, 0.6}) == red);
    CHECK(at({0.5, 0.5, 0.5}) == black);
    CHECK(at({0.8, 0.5, 0.5}) == Colour{128, 64, 0});
  }
}

TEST_CASE("what lies behind the viewer is cut off, not turned round") {
  // A long floor that passes below the viewer and on behind.
  Drawing drawing;
  drawing.surface.positions = {{-100, -1, 100}, {100, -1, 100}, {0, -1, -1000}};
  drawing.surface.triangles = {{0, 1, 2}};
  drawing.surface.colours = {{0, 0, 200}};
  drawing.lines.push_back({{0, -0.9, 100}, {0, -0.9, -100}, {255, 0, 0}, 3});
  drawing.dots.push_back({{0, 0, 100}, {0, 255, 0}, 50});
  const Camera camera({{0, 0, -1}, {0, 1, 0}, 60}, {Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}, 100, 100);
  const Image image = draw(drawing, camera, 100, 100);
  for (std::size_t x = 0; x < 100; ++x) {
    CHECK(image.at(x, 10) == white);
    CHECK(image.at(x, 40) == white);
    CHECK(image.at(x, 99) != white);
  }
  CHECK(image.at(50, 90) == Colour{255, 0, 0});
  CHECK(image.at(20, 90).r == 0);
}
