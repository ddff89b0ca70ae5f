// The rasteriser, see canvas.hpp. Corners are rounded to 1/256 of a sample, after which the test whether a
// sample is inside is exact in integers: triangles that share an edge leave neither gap nor overlap.
#include "snip/render/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snip {
namespace {

constexpr std::int64_t sub = 256;  // positions per sample
/// Coordinates beyond this are clipped: products of differences of fixed-point coordinates then fit easily.
constexpr double guard = 1 << 20;

bool finite(const ScreenPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.nearness);
}

ScreenPoint scaled(const ScreenPoint& p, std::size_t samples) {
  const auto s = static_cast<double>(samples);
  return {p.x * s, p.y * s, p.nearness};
}

/// Keeps the part of a convex polygon where distance(p) >= 0; distance has to be linear in x and y.
template <class Distance>
std::vector<ScreenPoint> clipped(const std::vector<ScreenPoint>& polygon, Distance distance) {
  std::vector<ScreenPoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = distance(a), db = distance(b);
    if (da >= 0) kept.push_back(a);
    if ((da >= 0) == (db >= 0)) continue;
    const double t = da / (da - db);
    kept.push_back(
        {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.nearness + t * (b.nearness - a.nearness)});
  }
  return kept;
}

/// The edge from (ax, ay) to (bx, by): positive values lie inside.
struct Edge {
  std::int64_t step_x, step_y, value;  // value at the middle of the first sample
  Edge(std::array<std::int64_t, 2> a, std::array<std::int64_t, 2> b, std::int64_t x, std::int64_t y) {
    const std::int64_t dx = b[0] - a[0], dy = b[1] - a[1];
    step_x = -dy * sub;
    step_y = dx * sub;
    value = dx * (y - a[1]) - dy * (x - a[0]);
    // A sample on the edge itself belongs to the triangle below or to the right of it.
    const bool owns_border = dy < 0 || (dy == 0 && dx > 0);
    if (!owns_border) --value;
  }
};

}  // namespace

Canvas::Canvas(std::size_t width, std::size_t height, Colour background, std::size_t samples)
    : width_(width * samples),
      height_(height * samples),
      samples_(samples),
      colours_(width_ * height_, background),
      nearness_(width_ * height_, -std::numeric_limits<float>::infinity()) {}

void Canvas::mix(std::size_t sample, Colour colour, double opacity) {
  const auto part = static_cast<int>(std::lround(opacity * 256));
  const auto mixed = [part](std::uint8_t below, std::uint8_t above) {
    return static_cast<std::uint8_t>((below * (256 - part) + above * part + 128) / 256);
  };
  Colour& c = colours_[sample];
  c = {mixed(c.r, colour.r), mixed(c.g, colour.g), mixed(c.b, colour.b)};
}

void Canvas::fill_triangle(const std::array<ScreenPoint, 3>& corners, Colour colour, double opacity) {
  std::array<ScreenPoint, 3> p;
  bool within = true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!finite(corners[i])) return;
    p[i] = scaled(corners[i], samples_);
    within = within && std::abs(p[i].x) <= guard && std::abs(p[i].y) <= guard;
  }
  if (within) return fill_small_triangle(p, colour, opacity);
  std::vector<ScreenPoint> polygon(p.begin(), p.end());
  polygon = clipped(polygon, [](const ScreenPoint& q) { return q.x + guard; });
  polygon = clipped(polygon, [](const ScreenPoint& q) { return guard - q.x; });
  polygon = clipped(polygon, [](const ScreenPoint& q) { return q.y + guard; });
  polygon = clipped(polygon, [](const ScreenPoint& q) { return guard - q.y; });
  for (std::size_t i = 2; i < polygon.size(); ++i)
    fill_small_triangle({polygon[0], polygon[i - 1], polygon[i]}, colour, opacity);
}

void Canvas::fill_small_triangle(const std::array<ScreenPoint, 3>& corners, Colour colour, double opacity) {
  std::array<std::array<std::int64_t, 2>, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = {std::llround(corners[i].x * sub), std::llround(corners[i].y * sub)};
  std::size_t second = 1, third = 2;
  const auto doubled_area = [&] {
    return (p[second][0] - p[0][0]) * (p[third][1] - p[0][1]) -
           (p[second][1] - p[0][1]) * (p[third][0] - p[0][0]);
  };
  if (doubled_area() < 0) std::swap(second, third);
  const auto area = static_cast<double>(doubled_area());
  if (area == 0) return;
  const auto bound = [](std::int64_t value, std::size_t size) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(value, 0, static_cast<std::int64_t>(size)));
  };
  const auto [low_x, high_x] = std::minmax({p[0][0], p[1][0], p[2][0]});
  const auto [low_y, high_y] = std::minmax({p[0][1], p[1][1], p[2][1]});
  const std::size_t x0 = bound(low_x / sub, width_), x1 = bound(high_x / sub + 1, width_);
  const std::size_t y0 = bound(low_y / sub, height_), y1 = bound(high_y / sub + 1, height_);
  const auto first_x = static_cast<std::int64_t>(x0) * sub + sub / 2;
  const auto first_y = static_cast<std::int64_t>(y0) * sub + sub / 2;
  std::array<Edge, 3> edge{Edge(p[second], p[third], first_x, first_y),
                           Edge(p[third], p[0], first_x, first_y), Edge(p[0], p[second], first_x, first_y)};

  // Nearness over the picture is a plane: from the differences to the first corner.
  const double ax = static_cast<double>(p[second][0] - p[0][0]),
               ay = static_cast<double>(p[second][1] - p[0][1]);
  const double bx = static_cast<double>(p[third][0] - p[0][0]),
               by = static_cast<double>(p[third][1] - p[0][1]);
  const double an = corners[second].nearness - corners[0].nearness,
               bn = corners[third].nearness - corners[0].nearness;
  const double slope_x = (an * by - bn * ay) / area, slope_y = (bn * ax - an * bx) / area;
  const double start = corners[0].nearness + slope_x * static_cast<double>(first_x - p[0][0]) +
                       slope_y * static_cast<double>(first_y - p[0][1]);

  for (std::size_t y = y0; y < y1; ++y) {
    std::array<std::int64_t, 3> value{edge[0].value, edge[1].value, edge[2].value};
    const double row = start + slope_y * static_cast<double>(sub) * static_cast<double>(y - y0);
    bool entered = false;
    for (std::size_t x = x0; x < x1; ++x) {
      if ((value[0] | value[1] | value[2]) >= 0) {
        entered = true;
        const std::size_t i = y * width_ + x;
        const auto nearness =
            static_cast<float>(row + slope_x * static_cast<double>(sub) * static_cast<double>(x - x0));
        if (nearness > nearness_[i]) {
          if (opacity < 1) {
            mix(i, colour, opacity);
          } else {
            colours_[i] = colour;
            nearness_[i] = nearness;
          }
        }
      } else if (entered) {
        break;
      }
      for (std::size_t k = 0; k < 3; ++k) value[k] += edge[k].step_x;
    }
    for (Edge& e : edge) e.value += e.step_y;
  }
}

void Canvas::draw_line(const ScreenPoint& from, const ScreenPoint& to, double width, Colour colour) {
  if (!finite(from) || !finite(to)) return;
  const double radius = width * static_cast<double>(samples_) / 2, reach = radius + 1;
  const double densest = std::min(1.0, 2 * radius);  // a line thinner than a sample fades
  const auto w = static_cast<double>(width_), h = static_cast<double>(height_);
  std::vector<ScreenPoint> line{scaled(from, samples_), scaled(to, samples_)};
  // Away from the canvas a line costs time and shows nothing.
  line = clipped(line, [&](const ScreenPoint& p) { return p.x + reach; });
  line = clipped(line, [&](const ScreenPoint& p) { return w + reach - p.x; });
  line = clipped(line, [&](const ScreenPoint& p) { return p.y + reach; });
  line = clipped(line, [&](const ScreenPoint& p) { return h + reach - p.y; });
  if (line.size() < 2) return;
  ScreenPoint a = line[0], b = line[1];
  // Walk along the longer axis; `flat` lines walk along x.
  const bool flat = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
  if (!flat) std::swap(a.x, a.y), std::swap(b.x, b.y);
  if (a.x > b.x) std::swap(a, b);
  const std::size_t walk_size = flat ? width_ : height_, cross_size = flat ? height_ : width_;
  const double dx = b.x - a.x, dy = b.y - a.y, length_squared = dx * dx + dy * dy;
  const double slope = dx > 0 ? dy / dx : 0, half_height = reach * std::sqrt(1 + slope * slope);
  const auto bound = [](double value, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(size)));
  };
  for (std::size_t u = bound(a.x - reach, walk_size); u < bound(b.x + reach + 1, walk_size); ++u) {
    const double x = static_cast<double>(u) + 0.5, y_line = a.y + slope * (x - a.x);
    for (std::size_t v = bound(y_line - half_height, cross_size);
         v < bound(y_line + half_height + 1, cross_size); ++v) {
      const double y = static_cast<double>(v) + 0.5;
      const double along = length_squared > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / length_squared : 0;
      const double t = std::clamp(along, 0.0, 1.0);
      const double off_x = x - a.x - t * dx, off_y = y - a.y - t * dy;
      const double coverage = radius + 0.5 - std::sqrt(off_x * off_x + off_y * off_y);
      const std::size_t i = flat ? v * width_ + u : u * width_ + v;
      const double nearness = a.nearness + t * (b.nearness - a.nearness);
      if (coverage > 0 && static_cast<float>(nearness) >= nearness_[i])
        mix(i, colour, std::min(coverage, densest));
    }
  }
}

void Canvas::draw_dot(const ScreenPoint& middle, double diameter, Colour colour) {
  draw_line(middle, middle, diameter, colour);
}

Image Canvas::image() const {
  Image image{width_ / samples_, height_ / samples_, {}};
  image.rgb.resize(3 * image.width * image.height);
  const auto count = static_cast<unsigned>(samples_ * samples_);
  for (std::size_t y = 0; y < image.height; ++y)
    for (std::size_t x = 0; x < image.width; ++x) {
      unsigned r = count / 2, g = r, b = r;  // rounds to nearest
      for (std::size_t i = 0; i < samples_; ++i)
        for (std::size_t j = 0; j < samples_; ++j) {
          const Colour& c = colours_[(y * samples_ + i) * width_ + x * samples_ + j];
          r += c.r, g += c.g, b += c.b;
        }
      const std::size_t at = 3 * (y * image.width + x);
      image.rgb[at] = static_cast<std::uint8_t>(r / count);
      image.rgb[at + 1] = static_cast<std::uint8_t>(g / count);
      image.rgb[at + 2] = static_cast<std::uint8_t>(b / count);
    }
  return image;
}

}  // namespace snip
