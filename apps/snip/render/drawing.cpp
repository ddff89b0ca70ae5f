// Drawing, see drawing.hpp: brings everything into the view of the camera, cuts off what is behind it,
// shades, and hands it to the canvas in the order that Canvas asks for.
#include "snip/render/drawing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "snip/render/canvas.hpp"

namespace snip {
namespace {

using Eigen::Vector3d;

/// The part of a triangle in front of the viewer: none, three or four corners.
std::vector<Vector3d> in_front(const std::array<Vector3d, 3>& corners, double limit) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.z() >= limit) kept.push_back(a);
    if ((a.z() >= limit) != (b.z() >= limit)) {
      Vector3d crossing = a + (limit - a.z()) / (b.z() - a.z()) * (b - a);
      crossing.z() = limit;  // not a rounding error less
      kept.push_back(crossing);
    }
  }
  return kept;
}

void fill(Canvas& canvas, const Camera& camera, const std::array<Vector3d, 3>& corners, Colour colour,
          double opacity) {
  const double limit = camera.near_limit();
  if (corners[0].z() >= limit && corners[1].z() >= limit && corners[2].z() >= limit) {
    canvas.fill_triangle(
        {camera.to_screen(corners[0]), camera.to_screen(corners[1]), camera.to_screen(corners[2])}, colour,
        opacity);
    return;
  }
  const std::vector<Vector3d> kept = in_front(corners, limit);
  for (std::size_t i = 2; i < kept.size(); ++i)
    canvas.fill_triangle(
        {camera.to_screen(kept[0]), camera.to_screen(kept[i - 1]), camera.to_screen(kept[i])}, colour,
        opacity);
}

/// Lambert's law for a lamp to the upper left of the viewer, half of the light from everywhere, and the
/// side that is turned away a little darker, so that a flap that turned over shows.
Colour shaded(Colour colour, const std::array<Vector3d, 3>& corners, bool perspective) {
  // (right, up, forward) are left-handed, hence the order.
  const Vector3d normal = (corners[2] - corners[0]).cross(corners[1] - corners[0]);
  const double length = normal.norm();
  if (!(length > 0)) return colour;
  const Vector3d lamp = Vector3d(-0.35, 0.5, -1).normalized();
  const Vector3d sight = perspective ? corners[0] : Vector3d(0, 0, 1);
  const double light = 0.45 + 0.65 * std::abs(normal.dot(lamp)) / length;
  const double brightness = std::min(light, 1.0) * (normal.dot(sight) < 0 ? 1.0 : 0.8);
  const auto dimmed = [&](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c * brightness)); };
  return {dimmed(colour.r), dimmed(colour.g), dimmed(colour.b)};
}

void draw_surface(Canvas& canvas, const Camera& camera, const Surface& surface) {
  std::vector<Vector3d> in_view;
  in_view.reserve(surface.positions.size());
  for (const Vector3d& p : surface.positions) in_view.push_back(camera.to_view(p));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const std::array<Vector3d, 3> corners{in_view[a], in_view[b], in_view[c]};
    if (!(corners[0] + corners[1] + corners[2]).allFinite()) continue;
    fill(canvas, camera, corners, shaded(surface.colours[t], corners, camera.is_perspective()), 1);
  }
}

void draw_line(Canvas& canvas, const Camera& camera, const Line& line) {
  Vector3d from = camera.lifted(camera.to_view(line.from)), to = camera.lifted(camera.to_view(line.to));
  const double limit = camera.near_limit();
  if (!(from + to).allFinite() || std::max(from.z(), to.z()) < limit) return;
  if (from.z() > to.z()) std::swap(from, to);
  if (from.z() < limit) {
    from += (limit - from.z()) / (to.z() - from.z()) * (to - from);
    from.z() = limit;
  }
  canvas.draw_line(camera.to_screen(from), camera.to_screen(to), line.width, line.colour);
}

}  // namespace

Image draw(const Drawing& drawing, const Camera& camera, std::size_t width, std::size_t height,
           Colour background) {
  Canvas canvas(width, height, background);
  draw_surface(canvas, camera, drawing.surface);
  for (const Line& line : drawing.lines) draw_line(canvas, camera, line);
  for (const Dot& dot : drawing.dots) {
    const Vector3d middle = camera.lifted(camera.to_view(dot.middle));
    if (middle.allFinite() && middle.z() >= camera.near_limit())
      canvas.draw_dot(camera.to_screen(middle), dot.diameter, dot.colour);
  }
  for (const Pane& pane : drawing.panes) {
    const std::array<Vector3d, 3> corners{camera.to_view(pane.corners[0]), camera.to_view(pane.corners[1]),
                                          camera.to_view(pane.corners[2])};
    if ((corners[0] + corners[1] + corners[2]).allFinite())
      fill(canvas, camera, corners, pane.colour, pane.opacity);
  }
  return canvas.image();
}

Colour piece_colour(std::size_t piece) {
  static constexpr std::array<Colour, 12> palette{{{246, 224, 150},
                                                   {158, 202, 232},
                                                   {240, 160, 140},
                                                   {170, 215, 155},
                                                   {205, 170, 220},
                                                   {245, 190, 110},
                                                   {140, 210, 205},
                                                   {235, 170, 200},
                                                   {200, 205, 130},
                                                   {165, 175, 235},
                                                   {215, 185, 160},
                                                   {180, 190, 195}}};
  return palette[piece % palette.size()];
}

}  // namespace snip
