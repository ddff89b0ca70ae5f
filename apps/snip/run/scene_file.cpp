// Reads scene files: one function for each object of docs/scene_file.md, in its order.
#include "snip/run/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "snip/mesh_file/mesh_file.hpp"
#include "snip/run/json_reader.hpp"
#include "snip/run/mesh_source.hpp"
#include "snip/whole_file.hpp"

namespace snip {
namespace {

using Eigen::Vector3d;

/// Overwrites the default when the key is there.
template <class T, class Read>
void take(const JsonValue& object, const char* key, T& target, Read read) {
  if (const auto value = object.find(key)) target = read(*value);
}

double positive(const JsonValue& v) { return v.positive(); }
double not_negative(const JsonValue& v) { return v.not_negative(); }
double number(const JsonValue& v) { return v.number(); }
bool boolean(const JsonValue& v) { return v.boolean(); }
Vector3d vector(const JsonValue& v) { return v.vector(); }
std::string text(const JsonValue& v) { return v.text(); }

auto count(std::size_t least, std::size_t most) {
  return [=](const JsonValue& v) { return v.count(least, most); };
}

Eigen::AlignedBox3d read_box(const JsonValue& value) {
  const auto corners = value.list(2, 2);
  const Vector3d low = corners[0].vector(), high = corners[1].vector();
  if ((low.array() > high.array()).any())
    value.fail("the first corner has to be the lower one in x, y and z");
  return {low, high};
}

void read_material(const JsonValue& value, Scene& scene) {
  value.allow_keys({"mode", "density", "mass", "stiffness", "damping", "bending_stiffness", "bending_damping",
                    "tear_limit"});
  scene.material_place = value.place();
  if (value.has("density") && value.has("mass")) value.fail("only one of density and mass can be given");
  cut::Material& material = scene.material;
  take(value, "mode", material.mode, [](const JsonValue& v) {
    return std::array{cut::MaterialMode::conserving,
                      cut::MaterialMode::paper}[v.word({"conserving", "paper"})];
  });
  take(value, "density", material.density, positive);
  take(value, "mass", scene.mass, positive);
  take(value, "stiffness", material.stiffness, not_negative);
  take(value, "damping", material.damping, not_negative);
  // What is not given follows from what is, as in a Material.
  material = {material.mode, material.density, material.stiffness, material.damping};
  take(value, "bending_stiffness", material.bending_stiffness, not_negative);
  material = {material.mode, material.density, material.stiffness, material.damping,
              material.bending_stiffness};
  take(value, "bending_damping", material.bending_damping, not_negative);
  take(value, "tear_limit", scene.tear_limit, positive);
  if (value.has("tear_limit") && !(scene.tear_limit > 1))
    value.at("tear_limit").fail("has to be greater than 1: it is a length over the length without tension");
}

/// Keyframes by increasing time, at least so many.
void read_keyframes(const JsonValue& value, std::size_t least, std::vector<Keyframe>& keyframes) {
  for (const JsonValue& item : value.list(least)) {
    item.allow_keys({"at", "move", "degrees"});
    Keyframe keyframe;
    keyframe.at = item.at("at").not_negative();
    take(item, "move", keyframe.move, vector);
    take(item, "degrees", keyframe.degrees, number);
    if (!keyframes.empty() && !(keyframe.at > keyframes.back().at))
      item.at("at").fail("has to be later than the keyframe before");
    keyframes.push_back(keyframe);
  }
}

Anchor read_anchor(const JsonValue& value) {
  value.allow_keys({"box", "nodes", "axis", "keyframes"});
  Anchor anchor;
  anchor.place = value.place();
  if (value.one_of({"box", "nodes"}) == "box") {
    anchor.box = read_box(value.at("box"));
  } else {
    for (const JsonValue& node : value.at("nodes").list(1))
      anchor.nodes.push_back(static_cast<std::uint32_t>(node.count(0, 0xfffffffe)));
  }
  take(value, "axis", anchor.axis, [](const JsonValue& v) { return v.nonzero_vector(); });
  if (const auto keyframes = value.find("keyframes")) {
    const JsonValue first = keyframes->list(1)[0].at("at");
    if (!(first.number() > 0))
      first.fail("has to be greater than 0: at the start the anchor is where the cloth is");
    anchor.keyframes.push_back({});
    read_keyframes(*keyframes, 1, anchor.keyframes);
  } else if (value.has("axis")) {
    value.at("axis").fail("is what keyframes turn the anchor about, and there are none");
  }
  return anchor;
}

MergeSettings read_merge(const JsonValue& value) {
  value.allow_keys({"cut", "node", "edge"});
  MergeSettings merge;
  merge.place = value.place();
  take(value, "cut", merge.cut, positive);
  take(value, "node", merge.node, positive);
  take(value, "edge", merge.edge, positive);
  return merge;
}

StaticCutter read_static_cutter(const JsonValue& value) {
  value.allow_keys({"mesh", "at", "interval", "times", "step"});
  StaticCutter cutter;
  cutter.mesh = read_mesh_source(value.at("mesh"));
  take(value, "at", cutter.at, not_negative);
  take(value, "interval", cutter.interval, positive);
  take(value, "times", cutter.times, count(1, 1'000'000));
  take(value, "step", cutter.step, vector);
  if (cutter.times > 1 && cutter.interval == 0)
    value.fail("a cutter that cuts more than once wants an interval");
  return cutter;
}

MovingBlade read_blade(const JsonValue& value) {
  value.allow_keys({"edge", "axis", "keyframes"});
  MovingBlade blade;
  blade.place = value.place();
  for (const JsonValue& point : value.at("edge").list(2)) blade.edge.push_back(point.vector());
  take(value, "axis", blade.axis, [](const JsonValue& v) { return v.nonzero_vector(); });
  read_keyframes(value.at("keyframes"), 2, blade.keyframes);
  return blade;
}

void read_cutter(const JsonValue& value, Scene& scene) {
  if (value.one_of({"mesh", "blade"}) == "mesh") {
    scene.cutters.push_back(read_static_cutter(value));
  } else {
    value.allow_keys({"blade"});
    scene.blades.push_back(read_blade(value.at("blade")));
  }
}

void read_camera(const JsonValue& value, OutputSettings& output) {
  value.allow_keys({"direction", "up", "field_of_view", "box"});
  take(value, "direction", output.view.direction, [](const JsonValue& v) { return v.nonzero_vector(); });
  take(value, "up", output.view.up, [](const JsonValue& v) { return v.nonzero_vector(); });
  take(value, "field_of_view", output.view.field_of_view, not_negative);
  if (output.view.field_of_view > 120) value.at("field_of_view").fail("can be at most 120 degrees");
  take(value, "box", output.view_box, read_box);
}

OutputSettings read_output(const JsonValue& value) {
  value.allow_keys({"width", "height", "picture_interval", "animation_interval", "colours", "physics",
                    "cutters", "csv", "mesh", "camera"});
  OutputSettings output;
  output.place = value.place();
  take(value, "width", output.width, count(1, 16383));
  take(value, "height", output.height, count(1, 16383));
  if (output.width * output.height > most_pixels)
    value.at(value.has("width") ? "width" : "height")
        .fail(fmt::format("width times height can be at most {}, is {} times {}", most_pixels, output.width,
                          output.height));
  take(value, "picture_interval", output.picture_interval, count(0, most_frames));
  take(value, "animation_interval", output.animation_interval, count(0, most_frames));
  take(value, "colours", output.colour_pieces,
       [](const JsonValue& v) { return v.word({"plain", "pieces"}) == 1; });
  take(value, "physics", output.show_physics, boolean);
  take(value, "cutters", output.show_cutters, boolean);
  take(value, "csv", output.csv, boolean);
  take(value, "mesh", output.mesh, text);
  if (output.mesh.find_first_of("/\\") != std::string::npos)
    value.at("mesh").fail("is the name of a file in the output folder and cannot have a slash");
  if (!output.mesh.empty())
    if (const auto format = format_of(output.mesh); !format) value.at("mesh").fail(format.error().message);
  if (const auto camera = value.find("camera")) read_camera(*camera, output);
  return output;
}

void read_half_space(const JsonValue& value, Scene& scene) {
  value.allow_keys({"point", "normal", "velocity", "friction"});
  cut::HalfSpace half_space;
  take(value, "point", half_space.point, vector);
  take(value, "normal", half_space.normal, [](const JsonValue& v) { return v.nonzero_vector(); });
  take(value, "velocity", half_space.velocity, vector);
  take(value, "friction", half_space.friction, not_negative);
  scene.surroundings.half_spaces.push_back(half_space);
  scene.half_space_places.push_back(value.place());
}

void read_sphere(const JsonValue& value, Scene& scene) {
  value.allow_keys({"centre", "radius", "velocity", "friction"});
  cut::Sphere sphere;
  take(value, "centre", sphere.centre, vector);
  take(value, "radius", sphere.radius, positive);
  take(value, "velocity", sphere.velocity, vector);
  take(value, "friction", sphere.friction, not_negative);
  scene.surroundings.spheres.push_back(sphere);
  scene.sphere_places.push_back(value.place());
}

void read_obstacle(const JsonValue& value, Scene& scene) {
  value.allow_keys({"half_space", "sphere"});
  if (value.one_of({"half_space", "sphere"}) == "half_space")
    read_half_space(value.at("half_space"), scene);
  else
    read_sphere(value.at("sphere"), scene);
}

void read_surroundings(const JsonValue& value, Scene& scene) {
  scene.surroundings.gravity = {0, 0, -9.81};
  take(value, "gravity", scene.surroundings.gravity, vector);
  take(value, "air_drag", scene.surroundings.air_drag, not_negative);
  take(value, "normal_drag", scene.surroundings.normal_drag, not_negative);
  take(value, "wind", scene.surroundings.wind, vector);
  take(value, "longest_way", scene.surroundings.longest_way, positive);
  take(value, "integrator", scene.surroundings.integrator, [](const JsonValue& v) {
    return std::array{
        cut::Integrator::forward_euler, cut::Integrator::semi_implicit_euler,
        cut::Integrator::implicit_euler}[v.word({"forward_euler", "semi_implicit_euler", "implicit_euler"})];
  });
  if (const auto obstacles = value.find("obstacles"))
    for (const JsonValue& obstacle : obstacles->list()) read_obstacle(obstacle, scene);
}

void read_scene_object(const JsonValue& value, Scene& scene) {
  value.allow_keys({"description", "cloth", "material", "anchors", "gravity", "air_drag", "normal_drag",
                    "wind", "longest_way", "obstacles", "integrator", "time_step", "steps_per_frame",
                    "frames", "merge", "cutters", "output"});
  take(value, "description", scene.description, text);
  scene.cloth = read_mesh_source(value.at("cloth"));
  if (const auto material = value.find("material")) read_material(*material, scene);
  if (const auto anchors = value.find("anchors"))
    for (const JsonValue& anchor : anchors->list()) scene.anchors.push_back(read_anchor(anchor));
  read_surroundings(value, scene);
  take(value, "time_step", scene.time_step, positive);
  take(value, "steps_per_frame", scene.steps_per_frame, count(1, 1'000'000));
  take(value, "frames", scene.frames, count(1, most_frames));
  take(value, "merge", scene.merge, read_merge);
  if (const auto cutters = value.find("cutters"))
    for (const JsonValue& cutter : cutters->list()) read_cutter(cutter, scene);
  take(value, "output", scene.output, read_output);
}

}  // namespace

Result<Scene> parse_scene(std::string_view text, const std::string& name) {
  Scene scene;
  scene.material_place = scene.output.place = name;
  if (const auto read =
          read_json(text, name, [&](const JsonValue& value) { read_scene_object(value, scene); });
      !read)
    return read.error();
  return scene;
}

Result<Scene> read_scene(const std::filesystem::path& path) {
  const auto text = read_whole_file(path);
  if (!text) return text.error();
  return parse_scene(*text, path.string());
}

}  // namespace snip
