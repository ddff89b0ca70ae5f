// The meshes of a scene file, see mesh_source.hpp. A table of shapes: keys, defaults, the mesh.
#include "snip/run/mesh_source.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <scenes/surfaces.hpp>

namespace snip {
namespace {

using cut::TriangleMesh;
using Eigen::Vector3d;

/// Triangles a generated mesh can have: a cloth of that many takes 4 GB.
constexpr std::size_t most_triangles = 6'000'000;

double positive_or(const JsonValue& value, const char* key, double otherwise) {
  const auto given = value.find(key);
  return given ? given->positive() : otherwise;
}

/// Two counts, each at least `least`, whose product is at most `most`.
std::array<std::size_t, 2> counts(const JsonValue& value, const char* first, const char* second,
                                  std::size_t least, std::size_t most = most_triangles / 2) {
  const std::size_t a = value.at(first).count(least, most / least),
                    b = value.at(second).count(least, most / least);
  if (a > most / b)
    value.fail(fmt::format("{} times {} can be at most {}, is {} times {}", first, second, most, a, b));
  return {a, b};
}

scenes::Path read_path(const JsonValue& value, std::size_t least) {
  scenes::Path path;
  if (value.is_list()) {
    for (const JsonValue& point : value.list(least)) path.push_back(point.vector());
    return path;
  }
  value.allow_keys({"circle", "wave"});
  const std::string_view kind = value.one_of({"circle", "wave"});
  const JsonValue curve = value.at(kind);
  if (kind == "circle") {
    curve.allow_keys({"centre", "u", "v", "count"});
    return scenes::circle_path(curve.at("centre").vector(), curve.at("u").nonzero_vector(),
                               curve.at("v").nonzero_vector(), curve.at("count").count(3, 1'000'000));
  }
  curve.allow_keys({"from", "to", "swing", "waves", "segments"});
  return scenes::wave_path(curve.at("from").vector(), curve.at("to").vector(), curve.at("swing").vector(),
                           positive_or(curve, "waves", 1), curve.at("segments").count(2, 1'000'000));
}

std::vector<Vector3d> corners(const JsonValue& value, std::size_t count) {
  std::vector<Vector3d> points;
  for (const JsonValue& point : value.at("corners").list(count, count)) points.push_back(point.vector());
  return points;
}

Eigen::Affine3d read_placement(const JsonValue& value) {
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  if (const auto move = value.find("move")) placement.translate(move->vector());
  if (const auto turn = value.find("turn")) {
    turn->allow_keys({"axis", "degrees"});
    const Vector3d axis = turn->at("axis").nonzero_vector().normalized();
    placement.rotate(Eigen::AngleAxisd(turn->at("degrees").number() * std::numbers::pi / 180, axis));
  }
  if (const auto scale = value.find("scale")) placement.scale(scale->positive());
  return placement;
}

}  // namespace

const std::vector<MeshShape>& mesh_shapes() {
  static const std::vector<MeshShape> shapes{
      {"twelve_triangles",
       {"side"},
       [](const JsonValue& v) { return scenes::twelve_triangles(positive_or(v, "side", 1)); }},
      {"grid",
       {"columns", "rows", "spacing", "diagonals"},
       [](const JsonValue& v) {
         const auto [columns, rows] = counts(v, "columns", "rows", 1);
         const auto diagonals = v.find("diagonals");
         const bool alternating = diagonals && diagonals->word({"uniform", "alternating"}) == 1;
         return scenes::grid(columns, rows, positive_or(v, "spacing", 1),
                             alternating ? scenes::Diagonals::alternating : scenes::Diagonals::uniform);
       }},
      {"hexagon",
       {"rings", "side"},
       [](const JsonValue& v) {
         return scenes::hexagon(v.at("rings").count(1, 1000), positive_or(v, "side", 1));
       }},
      {"fan",
       {"count", "radius"},
       [](const JsonValue& v) {
         return scenes::fan(v.at("count").count(3, most_triangles), positive_or(v, "radius", 1));
       }},
      {"random_sheet",
       {"columns", "rows", "spacing", "seed"},
       [](const JsonValue& v) {
         const auto [columns, rows] = counts(v, "columns", "rows", 1, 1'000'000);
         const auto seed = v.find("seed");
         return scenes::random_sheet(columns, rows, positive_or(v, "spacing", 1),
                                     seed ? seed->count(0, 0xffffffffffffffffu) : 0);
       }},
      {"curved_sheet",
       {"cells", "side", "height"},
       [](const JsonValue& v) {
         const auto height = v.find("height");
         return scenes::curved_sheet(v.at("cells").count(1, 1732), positive_or(v, "side", 1),
                                     height ? height->number() : 0.1);
       }},
      {"sphere",
       {"level", "radius"},
       [](const JsonValue& v) {
         return scenes::sphere(v.at("level").count(0, 9), positive_or(v, "radius", 1));
       }},
      {"torus",
       {"around", "through", "radius", "tube_radius"},
       [](const JsonValue& v) {
         const auto [around, through] = counts(v, "around", "through", 3);
         return scenes::torus(around, through, positive_or(v, "radius", 1),
                              positive_or(v, "tube_radius", 0.4));
       }},
      {"cylinder",
       {"around", "along", "radius", "height"},
       [](const JsonValue& v) {
         const std::size_t around = v.at("around").count(3, most_triangles / 2);
         const std::size_t along = v.at("along").count(1, most_triangles / 2 / around);
         return scenes::cylinder(around, along, positive_or(v, "radius", 1), positive_or(v, "height", 2));
       }},
      {"moebius_strip",
       {"around", "across", "radius", "width"},
       [](const JsonValue& v) {
         const std::size_t around = v.at("around").count(5, most_triangles / 2);
         const std::size_t across = v.at("across").count(1, most_triangles / 2 / around);
         return scenes::moebius_strip(around, across, positive_or(v, "radius", 1),
                                      positive_or(v, "width", 0.6));
       }},
      {"triangle",
       {"corners"},
       [](const JsonValue& v) {
         const auto p = corners(v, 3);
         return scenes::triangle(p[0], p[1], p[2]);
       }},
      {"quad",
       {"corners"},
       [](const JsonValue& v) {
         const auto p = corners(v, 4);
         return scenes::quad(p[0], p[1], p[2], p[3]);
       }},
      {"plane",
       {"centre", "u", "v"},
       [](const JsonValue& v) {
         return scenes::plane(v.at("centre").vector(), v.at("u").nonzero_vector(),
                              v.at("v").nonzero_vector());
       }},
      {"ribbon",
       {"path", "through"},
       [](const JsonValue& v) {
         return scenes::ribbon(read_path(v.at("path"), 2), v.at("through").nonzero_vector());
       }},
      {"tube",
       {"path", "through"},
       [](const JsonValue& v) {
         return scenes::tube(read_path(v.at("path"), 3), v.at("through").nonzero_vector());
       }},
      {"e_shape",
       {"foot", "up", "across", "through"},
       [](const JsonValue& v) {
         return scenes::e_shape(v.at("foot").vector(), v.at("up").nonzero_vector(),
                                v.at("across").nonzero_vector(), v.at("through").nonzero_vector());
       }},
      {"star",
       {"centre", "u", "v", "through", "count"},
       [](const JsonValue& v) {
         return scenes::star(v.at("centre").vector(), v.at("u").nonzero_vector(), v.at("v").nonzero_vector(),
                             v.at("through").nonzero_vector(), v.at("count").count(1, 1'000'000));
       }},
  };
  return shapes;
}

MeshSource read_mesh_source(const JsonValue& value) {
  MeshSource source;
  source.place = value.place();
  if (value.one_of({"file", "shape"}) == "file") {
    value.allow_keys({"file", "scale", "turn", "move"});
    source.file = value.at("file").text();
    if (source.file.empty()) value.at("file").fail("cannot be empty");
  } else {
    std::vector<std::string_view> names;
    for (const MeshShape& shape : mesh_shapes()) names.push_back(shape.name);
    const MeshShape& shape = mesh_shapes()[value.at("shape").word(names)];
    std::vector<std::string_view> keys{"shape", "scale", "turn", "move"};
    keys.insert(keys.end(), shape.keys.begin(), shape.keys.end());
    value.allow_keys(keys);
    source.generated = shape.read(value);
  }
  source.placement = read_placement(value);
  return source;
}

}  // namespace snip
