/// @file
/// What a picture shows, in scene coordinates, and the one function that draws it.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "snip/render/camera.hpp"
#include "snip/render/image.hpp"

namespace snip {

/// An opaque triangle mesh in the light of a lamp beside the viewer, from both sides.
struct Surface {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Colour> colours;  ///< one for each triangle
};

/// Straight lines; widths are pixels.
struct Line {
  Eigen::Vector3d from, to;
  Colour colour;
  double width = 1.5;
};

/// Round marks; diameters are pixels.
struct Dot {
  Eigen::Vector3d middle;
  Colour colour;
  double diameter = 6;
};

/// A translucent triangle.
struct Pane {
  std::array<Eigen::Vector3d, 3> corners;
  Colour colour;
  double opacity = 0.4;
};

struct Drawing {
  Surface surface;
  std::vector<Line> lines;  ///< later ones lie on earlier ones
  std::vector<Dot> dots;    ///< lie on the lines
  std::vector<Pane> panes;  ///< lie on everything that they are in front of
};

/// Points that are not finite are left out, and so is what lies behind the viewer.
/// @pre width, height > 0
Image draw(const Drawing& drawing, const Camera& camera, std::size_t width, std::size_t height,
           Colour background = {255, 255, 255});

/// Well distinguishable light colours for pieces; piece 0 has the colour of cloth, and they repeat after 12.
Colour piece_colour(std::size_t piece);

}  // namespace snip
