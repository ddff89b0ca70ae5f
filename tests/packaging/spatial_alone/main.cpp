// Uses the folder libspatial alone: the headers are found and need nothing else.
#include <array>
#include <spatial/box.hpp>

int main() {
  const auto box = spatial::to_box<double, 2>(std::array<double, 2>{1, 2});
  return spatial::is_valid(box) && box.max[1] == 2 ? 0 : 1;
}
