/// @file
/// Sine and cosine with the same bits on every compiler and machine, which the C library does not promise:
/// results of cuts are compared by hash, so the scenes that they start from must agree to the last bit.
#pragma once
#include <Eigen/Core>

namespace scenes {

/// The point at angle `turns` · 2π on the unit circle, to within 3e-16. Only sums, products and floor are
/// used; whole and quarter turns are exact.
/// @pre |turns| < 2^40, beyond which the fraction of a turn has no digits to speak of.
Eigen::Vector2d circle_point(double turns);

}  // namespace scenes
