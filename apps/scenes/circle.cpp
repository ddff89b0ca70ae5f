// Sine and cosine, see circle.hpp: range reduction to an eighth of a turn to either side of a quarter turn,
// then the Taylor series, whose first term left out is below 5e-17 there.
#include "scenes/circle.hpp"

#include <cmath>

namespace scenes {

Eigen::Vector2d circle_point(double turns) {
  const double fraction = turns - std::floor(turns);
  const double quarter = std::floor(4 * fraction + 0.5);
  const double x = (fraction - quarter / 4) * 6.283185307179586476925;
  const double y = -x * x;
  double sine = 0, cosine = 0;
  for (int k = 16; k > 0; k -= 2) {
    cosine = (1 + cosine) * y / (k * (k - 1));
    sine = (1 + sine) * y / (k * (k + 1));
  }
  cosine = 1 + cosine;
  sine = x * (1 + sine);
  switch (static_cast<int>(quarter) % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace scenes
