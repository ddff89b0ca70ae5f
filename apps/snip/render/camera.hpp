/// @file
/// From points in space to points on the picture.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>

namespace snip {

/// From where a scene is looked at. Where it stands and how far away follows from what it has to show.
struct View {
  Eigen::Vector3d direction{0, 0, -1};  ///< from the eye into the scene, any length
  Eigen::Vector3d up{0, 1, 0};          ///< what is up in the picture; need not be perpendicular to direction
  double field_of_view = 30;  ///< degrees within which all of the scene appears: small is like a telephoto
                              ///< lens, 0 is orthographic
};

/// A point on the picture.
struct ScreenPoint {
  double x = 0, y = 0;  ///< pixels from the top left corner; the middle of the first pixel is (0.5, 0.5)
  double nearness = 0;  ///< larger is nearer to the eye; linear in x and y along a straight line or flat face
};

class Camera {
 public:
  /// Stands so that `box` just fits into a picture of width × height pixels with a margin of 5 % around it.
  /// Where direction is parallel to up, another up is taken. @pre the box is not empty and finite, direction
  /// is not zero, 0 <= field_of_view < 180
  Camera(const View& view, const Eigen::AlignedBox3d& box, std::size_t width, std::size_t height);

  /// (right, up, forward) from the eye, in the units of the scene.
  [[nodiscard]] Eigen::Vector3d to_view(const Eigen::Vector3d& point) const { return axes_ * (point - eye_); }
  /// @pre view_point.z() >= near_limit()
  [[nodiscard]] ScreenPoint to_screen(const Eigen::Vector3d& view_point) const;
  /// Nothing nearer than this can be shown; -infinity for an orthographic camera.
  [[nodiscard]] double near_limit() const { return near_limit_; }
  /// `view_point` moved towards the eye by a hair (1/200 of the diagonal of the box), so that a line on a
  /// face wins against the face.
  [[nodiscard]] Eigen::Vector3d lifted(const Eigen::Vector3d& view_point) const;
  [[nodiscard]] bool is_perspective() const { return perspective_; }

 private:
  Eigen::Matrix3d axes_;  // rows: right, up, forward
  Eigen::Vector3d eye_;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  // where a point straight ahead is shown
  double scale_ = 1;  // pixels per unit, at distance 1 for a perspective camera
  double near_limit_ = 0, lift_ = 0;
  bool perspective_ = true;
};

}  // namespace snip
