// Writes OFF, or COFF where there are colours.
#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/print.hpp"
#include "snip/mesh_file/scalar.hpp"

namespace snip {
namespace {

// Integers up to 255 stay integers; everything else becomes a fraction, which a decimal point must tell
// apart from an integer.
void append_colour(const Colours& colours, std::size_t vertex, std::string& out) {
  for (std::size_t c = 0; c < colours.types.size(); ++c) {
    const double value = colours.values[vertex][c];
    if (colours.types[c] == ScalarType::uint8) {
      print::number(out, rounded_to(ScalarType::uint8, value));
      continue;
    }
    std::string text;
    print::number(text, value / full_intensity(colours.types[c]));
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    out += text;
  }
}

}  // namespace

void write_off(const Mesh& mesh, std::string& out) {
  out += mesh.colours.empty() ? "OFF\n" : "COFF\n";
  print::integer(out, mesh.positions.size());
  out += ' ';
  print::integer(out, mesh.triangles.size());
  out += " 0\n";
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (const double value : mesh.positions[v]) print::number(out, value);
    if (!mesh.colours.empty()) append_colour(mesh.colours, v, out);
    out += '\n';
  }
  for (const Triangle& triangle : mesh.triangles) {
    out += '3';
    for (const std::uint32_t corner : triangle) {
      out += ' ';
      print::integer(out, corner);
    }
    out += '\n';
  }
}

}  // namespace snip
