/// @file
/// Values of the PLY number types as bytes of either order.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "snip/mesh_file/mesh.hpp"

namespace snip {

/// Size in bytes.
std::size_t size_of(ScalarType type);
/// The name that is written; readers also know the names with the number of bits, such as `float64`.
std::string_view name_of(ScalarType type);
/// The largest value of an integer type; 1 for float32 and float64: what full intensity of a colour is.
double full_intensity(ScalarType type);
/// The nearest value that the type can hold.
double rounded_to(ScalarType type, double value);
/// Decodes the first size_of(type) bytes.
double decode(ScalarType type, std::string_view bytes, bool big_endian);
/// Appends the value, rounded to the type, in little endian.
void encode(ScalarType type, double value, std::string& out);

}  // namespace snip
