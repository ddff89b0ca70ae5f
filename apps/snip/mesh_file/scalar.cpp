// Numbers as bytes; see the header.
#include "snip/mesh_file/scalar.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace snip {
namespace {

// Calls function with a value of the C++ type that stands for the PLY type.
template <class Function>
auto with_type(ScalarType type, Function function) {
  switch (type) {
    case ScalarType::int8:
      return function(std::int8_t{});
    case ScalarType::uint8:
      return function(std::uint8_t{});
    case ScalarType::int16:
      return function(std::int16_t{});
    case ScalarType::uint16:
      return function(std::uint16_t{});
    case ScalarType::int32:
      return function(std::int32_t{});
    case ScalarType::uint32:
      return function(std::uint32_t{});
    case ScalarType::float32:
      return function(float{});
    case ScalarType::float64:
      break;
  }
  return function(double{});
}

template <class T>
T converted(double value) {
  const double low = static_cast<double>(std::numeric_limits<T>::lowest());
  const double high = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<T>(std::clamp(std::is_integral_v<T> ? std::round(value) : value, low, high));
}

}  // namespace

std::size_t size_of(ScalarType type) {
  return with_type(type, [](auto value) { return sizeof value; });
}

std::string_view name_of(ScalarType type) {
  constexpr std::array<std::string_view, 8> names = {"char", "uchar", "short", "ushort",
                                                     "int",  "uint",  "float", "double"};
  return names[static_cast<std::size_t>(type)];
}

double full_intensity(ScalarType type) {
  return with_type(type, []<class T>(T) {
    return std::is_floating_point_v<T> ? 1.0 : static_cast<double>(std::numeric_limits<T>::max());
  });
}

double rounded_to(ScalarType type, double value) {
  return with_type(type, [&]<class T>(T) { return static_cast<double>(converted<T>(value)); });
}

double decode(ScalarType type, std::string_view bytes, bool big_endian) {
  return with_type(type, [&]<class T>(T value) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes.data(), sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    std::memcpy(&value, raw.data(), sizeof(T));
    return static_cast<double>(value);
  });
}

void encode(ScalarType type, double value, std::string& out) {
  with_type(type, [&]<class T>(T) {
    const T native = converted<T>(value);
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &native, sizeof(T));
    if (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    out.append(raw.data(), raw.size());
  });
}

}  // namespace snip
