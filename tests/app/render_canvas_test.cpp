// The rasteriser: exact pixels on pictures small enough to be checked by eye.
#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "snip/render/canvas.hpp"

using snip::Canvas;
using snip::Colour;
using snip::Image;
using snip::ScreenPoint;

namespace {

constexpr Colour white{255, 255, 255}, black{0, 0, 0}, red{255, 0, 0}, blue{0, 0, 255}, grey{128, 128, 128};

/// One character for each pixel: . white, # black, R red, B blue, + grey, ? anything else.
std::string text(const Image& image) {
  std::string lines;
  for (std::size_t y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < image.width; ++x) {
      const Colour c = image.at(x, y);
      lines += c == white ? '.' : c == black ? '#' : c == red ? 'R' : c == blue ? 'B' : c == grey ? '+' : '?';
    }
    lines += '\n';
  }
  return lines;
}

}  // namespace

TEST_CASE("a triangle covers the samples whose middle is inside") {
  Canvas canvas(4, 4, white, 1);
  canvas.fill_triangle({ScreenPoint{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, black);
  CHECK(text(canvas.image()) == "###.\n##..\n#...\n....\n");
}

TEST_CASE("the middle of a sample on a common edge belongs to one triangle, whatever the winding") {
  const ScreenPoint a{0, 0, 0}, b{4, 0, 0}, c{4, 4, 0}, d{0, 4, 0};
  Canvas canvas(4, 4, white, 1);
  canvas.fill_triangle({a, b, d}, black, 0.5);
  canvas.fill_triangle({d, b, c}, black, 0.5);
  CHECK(text(canvas.image()) == "++++\n++++\n++++\n++++\n");
  Canvas other(4, 4, white, 1);
  other.fill_triangle({a, d, b}, black, 0.5);
  other.fill_triangle({d, c, b}, black, 0.5);
  CHECK(text(other.image()) == "++++\n++++\n++++\n++++\n");
}

TEST_CASE("a fan whose corner and edges pass through middles of samples covers each sample once") {
  Canvas canvas(5, 5, white, 1);
  const ScreenPoint middle{2.5, 2.5, 0};
  const std::array<ScreenPoint, 8> rim{{{0.5, 0.5, 0},
                                        {2.5, 0.5, 0},
                                        {4.5, 0.5, 0},
                                        {4.5, 2.5, 0},
                                        {4.5, 4.5, 0},
                                        {2.5, 4.5, 0},
                                        {0.5, 4.5, 0},
                                        {0.5, 2.5, 0}}};
  for (std::size_t i = 0; i < 8; ++i) canvas.fill_triangle({middle, rim[i], rim[(i + 1) % 8]}, black, 0.5);
  CHECK(text(canvas.image()) == "++++.\n++++.\n++++.\n++++.\n.....\n");
}

TEST_CASE("what is nearer hides what is farther, in any order") {
  for (const bool near_first : {true, false}) {
    Canvas canvas(3, 1, white, 1);
    for (const bool near : {near_first, !near_first})
      canvas.fill_triangle(
          {ScreenPoint{-9, -9, near ? 2.0 : 1.0}, {9, -9, near ? 2.0 : 1.0}, {0, 9, near ? 2.0 : 1.0}},
          near ? red : blue);
    CHECK(text(canvas.image()) == "RRR\n");
  }
}

TEST_CASE("triangles that pass through each other meet in a line") {
  Canvas canvas(4, 1, white, 1);
  canvas.fill_triangle({ScreenPoint{0, -4, 0}, {4, -4, 4}, {0, 8, 0}}, red);
  canvas.fill_triangle({ScreenPoint{0, -4, 0}, {8, -4, 8}, {4, 8, 4}}, red);
  canvas.fill_triangle({ScreenPoint{-9, -9, 2}, {19, -9, 2}, {0, 19, 2}}, blue);
  CHECK(text(canvas.image()) == "BBRR\n");
}

TEST_CASE("several samples for each pixel smooth an edge") {
  Canvas canvas(2, 1, white, 2);
  canvas.fill_triangle({ScreenPoint{-9, -9, 0}, {0.5, -9, 0}, {-9, 19, 0}}, black);
  canvas.fill_triangle({ScreenPoint{0.5, -9, 0}, {0.5, 19, 0}, {-9, 19, 0}}, black);
  CHECK(canvas.image().at(0, 0) == Colour{128, 128, 128});
  CHECK(canvas.image().at(1, 0) == white);
}

TEST_CASE("coordinates far beyond the canvas are clipped, not wrapped") {
  for (const double far : {1e4, 1e7, 1e12, 1e200}) {
    Canvas canvas(3, 2, white, 1);
    canvas.fill_triangle({ScreenPoint{-far, -far, 1}, {far, -far, 1}, {0, far, 1}}, black);
    CHECK(text(canvas.image()) == "###\n###\n");
    canvas.draw_line({-far, 1, 2}, {far, 1, 2}, 4, red);
    CHECK(text(canvas.image()) == "RRR\nRRR\n");
  }
}

TEST_CASE("what is not finite or has no area is left out") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Canvas canvas(3, 3, white, 1);
  canvas.fill_triangle({ScreenPoint{nan, 0, 0}, {9, 0, 0}, {0, 9, 0}}, black);
  canvas.fill_triangle({ScreenPoint{0, inf, 0}, {9, 0, 0}, {0, 9, 0}}, black);
  canvas.fill_triangle({ScreenPoint{0, 0, nan}, {9, 0, 0}, {0, 9, 0}}, black);
  canvas.fill_triangle({ScreenPoint{0, 0, 0}, {9, 9, 0}, {3, 3, 0}}, black);
  canvas.draw_line({nan, 0, 0}, {3, 3, 0}, 2, black);
  canvas.draw_dot({1, 1, -inf}, 2, black);
  CHECK(text(canvas.image()) == "...\n...\n...\n");
}

TEST_CASE("lines: exact pixels, both directions, hidden by what is nearer") {
  for (const bool swapped : {false, true}) {
    ScreenPoint a{1, 1.5, 1}, b{5, 1.5, 1};
    if (swapped) std::swap(a, b);
    Canvas canvas(6, 3, white, 1);
    canvas.fill_triangle({ScreenPoint{3, -90, 2}, {90, -90, 2}, {3, 90, 2}}, blue);
    canvas.draw_line(a, b, 1, red);
    const Image image = canvas.image();
    CHECK(text(image).substr(0, 7) == "...BBB\n");
    CHECK(text(image).substr(8, 5) == "RRBBB");
    CHECK(image.at(0, 1) == Colour{255, 128, 128});  // half of the round end
  }
  Canvas upright(3, 4, white, 1);
  upright.draw_line({1.5, 0, 0}, {1.5, 4, 0}, 1, black);
  CHECK(text(upright.image()) == ".#.\n.#.\n.#.\n.#.\n");
}

TEST_CASE("a line thinner than a sample is paler, not narrower") {
  Canvas canvas(3, 2, white, 1);
  canvas.draw_line({1.5, -3, 0}, {1.5, 5, 0}, 0.5, black);
  CHECK(text(canvas.image()) == ".+.\n.+.\n");
}

TEST_CASE("dots are round") {
  Canvas canvas(7, 7, white, 1);
  canvas.draw_dot({3.5, 3.5, 0}, 4, black);
  const Image image = canvas.image();
  CHECK(image.at(3, 3) == black);
  CHECK(image.at(2, 3) == black);
  CHECK(image.at(1, 3) == Colour{128, 128, 128});
  CHECK(image.at(0, 3) == white);
  CHECK(image.at(1, 1) == white);
  for (std::size_t y = 0; y < 7; ++y)
    for (std::size_t x = 0; x < 7; ++x) {
      CHECK(image.at(x, y) == image.at(y, x));
      CHECK(image.at(x, y) == image.at(6 - x, y));
    }
}

TEST_CASE("translucent triangles tint and do not hide") {
  Canvas canvas(2, 1, white, 1);
  const std::array<ScreenPoint, 3> near{{{-9, -9, 2}, {9, -9, 2}, {0, 9, 2}}},
      far{{{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}};
  canvas.fill_triangle(near, red, 0.5);
  CHECK(canvas.image().at(0, 0) == Colour{255, 128, 128});
  canvas.fill_triangle(far, blue);
  CHECK(text(canvas.image()) == "BB\n");
}
