// Camera, see camera.hpp.
#include "snip/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace snip {
namespace {

using Eigen::Vector3d;

constexpr double margin = 0.05;

Eigen::Matrix3d view_axes(const View& view) {
  const Vector3d forward = view.direction.normalized();
  Vector3d right = forward.cross(view.up);
  if (right.norm() < 1e-6 * view.up.norm() || view.up.norm() == 0) right = forward.unitOrthogonal();
  right.normalize();
  Eigen::Matrix3d axes;
  axes << right.transpose(), right.cross(forward).transpose(), forward.transpose();
  return axes;
}

}  // namespace

Camera::Camera(const View& view, const Eigen::AlignedBox3d& box, std::size_t width, std::size_t height)
    : axes_(view_axes(view)), eye_(box.center()), perspective_(view.field_of_view > 0) {
  // A box that is hardly more than a point is looked at from where its distance can still be told.
  const double radius = std::max({box.diagonal().norm() / 2, 1e-6 * eye_.norm(), 1e-100});
  lift_ = radius / 100;
  near_limit_ = -std::numeric_limits<double>::infinity();
  if (perspective_) {
    const double distance = 1.01 * radius / std::sin(view.field_of_view * std::numbers::pi / 360);
    eye_ -= distance * axes_.row(2).transpose();
    near_limit_ = distance / 1000;
  }
  // The picture is panned and zoomed to the corners of the box.
  Eigen::AlignedBox2d seen;
  for (int i = 0; i < 8; ++i) {
    const ScreenPoint p = to_screen(to_view(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))));
    seen.extend(Eigen::Vector2d(p.x, p.y));
  }
  const Eigen::Vector2d picture(static_cast<double>(width), static_cast<double>(height));
  const Eigen::Vector2d size = seen.sizes().cwiseMax(seen.sizes().maxCoeff() * 1e-9);
  scale_ = size.maxCoeff() > 0 ? (picture * (1 - 2 * margin)).cwiseQuotient(size).minCoeff() : 1;
  middle_ = picture / 2 - scale_ * seen.center();
}

ScreenPoint Camera::to_screen(const Vector3d& p) const {
  const double scale = perspective_ ? scale_ / p.z() : scale_;
  return {middle_.x() + scale * p.x(), middle_.y() - scale * p.y(), perspective_ ? 1 / p.z() : -p.z()};
}

Vector3d Camera::lifted(const Vector3d& p) const {
  if (!perspective_) return p - Vector3d(0, 0, lift_);
  return p * std::max(1 - lift_ / std::max(p.norm(), lift_), 0.5);
}

}  // namespace snip
