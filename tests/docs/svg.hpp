/// @file
/// Draws the state of a flat hybrid mesh as an SVG, for docs/pictures. In: meshes. Out: text.
#pragma once
#include <cut/hybrid_mesh.hpp>
#include <cut/pieces.hpp>
#include <string>
#include <vector>

namespace docs {

using Point = Eigen::Vector2d;

/// A picture made of panels beside each other; each draws in the plane of the cloth.
class Svg {
 public:
  /// @param scale pixels per unit of the cloth
  Svg(double width, double height, double scale) : width_(width), height_(height), scale_(scale) {}

  /// What follows is drawn with the cloth's point (0, 0) at this pixel.
  void panel(double x, double y, const std::string& title);
  void line(const Point& from, const Point& to, const std::string& colour, double width, bool dashed = false);
  void ring(const Point& middle, double radius);  ///< radius in units of the cloth
  void dot(const Point& middle, double pixels, const std::string& fill, const std::string& stroke);
  void text(const Point& at, double dx, double dy, const std::string& words, const std::string& colour);
  /// Render polygons in the colour of their piece, physics edges green, internal edges red, contours dark;
  /// boundary nodes white, inner nodes red, physics nodes green. `offsets` moves pieces apart.
  void mesh(const cut::HybridMesh& mesh, const std::vector<Point>& offsets = {});

  [[nodiscard]] std::string str() const;

 private:
  [[nodiscard]] std::string pixels(const Point& p) const;  ///< "x,y"
  double width_, height_, scale_;
  Point origin_{0, 0};
  std::string body_;
};

/// All pictures of docs/pictures that are drawn from results: file name and content.
std::vector<std::pair<std::string, std::string>> pictures();

}  // namespace docs
