// Scene files: what is read, and what is said about each kind of mistake.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "snip/run/json_lines.hpp"
#include "snip/run/mesh_source.hpp"
#include "snip/run/scene_file.hpp"

using Eigen::Vector3d;
using snip::parse_scene;
using snip::Scene;

namespace {

const std::string cloth = R"("cloth": {"shape": "grid", "columns": 2, "rows": 3})";

Scene good(const std::string& text) {
  const auto scene = parse_scene(text, "s.json");
  REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
  return *scene;
}

std::string error(const std::string& text) {
  const auto scene = parse_scene(text, "s.json");
  return scene ? "no error" : scene.error().message;
}

/// The error of a scene with a cloth and one more line.
std::string error_with(const std::string& line) { return error("{\n" + cloth + ",\n" + line + "\n}"); }

std::string error_of_cloth(const std::string& line) { return error("{\"cloth\":\n{" + line + "}}"); }

std::string file_text(const std::string& path) {
  std::ifstream file(std::string(SNIP_SOURCE_DIR) + "/" + path);
  REQUIRE(file);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a cloth is all that a scene needs; the rest has defaults") {
  const Scene scene = good("{" + cloth + "}");
  CHECK(scene.cloth.generated.triangles.size() == 12);
  CHECK(scene.surroundings.gravity == Vector3d(0, 0, -9.81));
  CHECK(scene.surroundings.integrator == cut::Integrator::semi_implicit_euler);
  CHECK(scene.material == Scene{}.material);
  CHECK_FALSE(scene.mass);
  CHECK(scene.frame_time() == doctest::Approx(0.02));
  CHECK(scene.frames == 100);
  CHECK(scene.output.mesh == "final.obj");
  CHECK(scene.cutters.empty());
  CHECK(scene.anchors.empty());
}

TEST_CASE("every key reaches its place") {
  const Scene scene = good(R"({
    "description": "all of it",
    "cloth": {"file": "a/b.obj", "scale": 2, "turn": {"axis": [0, 0, 1], "degrees": 90}, "move": [5, 0, 0]},
    "material": {"mode": "paper", "mass": 3, "stiffness": 40, "damping": 0.5},
    "anchors": [{"box": [[0, 0, 0], [1, 2, 3]]}, {"nodes": [4, 7]}],
    "gravity": [0, -1, 0], "air_drag": 0.25, "normal_drag": 0.75, "wind": [1, 2, 3], "longest_way": 7,
    "integrator": "forward_euler", "obstacles": [
      {"sphere": {"centre": [1, 2, 3], "radius": 4, "velocity": [0, 0, 5], "friction": 0.5}},
      {"half_space": {"point": [0, 0, -1], "normal": [0, 1, 1], "velocity": [6, 0, 0], "friction": 0.25}}],
    "time_step": 0.0005, "steps_per_frame": 8, "frames": 77,
    "merge": {"cut": 0.1, "node": 0.05, "edge": 0.02},
    "cutters": [
      {"mesh": {"shape": "triangle", "corners": [[0, 0, 0], [1, 0, 0], [0, 1, 1]]},
       "at": 0.5, "interval": 0.25, "times": 4, "step": [0, 0, 1]},
      {"blade": {"edge": [[0, 0, -1], [0, 0, 1]], "axis": [0, 1, 0],
                 "keyframes": [{"at": 0}, {"at": 2, "move": [1, 0, 0], "degrees": 30}]}}
    ],
    "output": {"width": 320, "height": 200, "picture_interval": 3, "animation_interval": 0, "colours": "plain",
               "physics": false, "cutters": false, "csv": false, "mesh": "end.ply",
               "camera": {"direction": [1, 1, -1], "up": [0, 0, 1], "field_of_view": 0,
                          "box": [[-1, -1, -1], [1, 1, 1]]}}
  })");
  CHECK(scene.description == "all of it");
  CHECK(scene.cloth.file == "a/b.obj");
  CHECK((scene.cloth.placement * Vector3d(1, 0, 0)).isApprox(Vector3d(5, 2, 0)));
  CHECK(scene.material.mode == cut::MaterialMode::paper);
  CHECK(scene.mass == 3);
  CHECK(scene.material.stiffness == 40);
  CHECK(scene.material.damping == 0.5);
  REQUIRE(scene.anchors.size() == 2);
  CHECK(scene.anchors[0].box->max() == Vector3d(1, 2, 3));
  CHECK(scene.anchors[1].nodes == std::vector<std::uint32_t>{4, 7});
  CHECK(scene.surroundings.gravity == Vector3d(0, -1, 0));
  CHECK(scene.surroundings.air_drag == 0.25);
  CHECK(scene.surroundings.wind == Vector3d(1, 2, 3));
  CHECK(scene.surroundings.normal_drag == 0.75);
  CHECK(scene.surroundings.longest_way == 7);
  CHECK(scene.surroundings.integrator == cut::Integrator::forward_euler);
  REQUIRE(scene.surroundings.spheres.size() == 1);
  CHECK(scene.surroundings.spheres[0].centre == Vector3d(1, 2, 3));
  CHECK(scene.surroundings.spheres[0].radius == 4);
  CHECK(scene.surroundings.spheres[0].velocity == Vector3d(0, 0, 5));
  CHECK(scene.surroundings.spheres[0].friction == 0.5);
  REQUIRE(scene.surroundings.half_spaces.size() == 1);
  CHECK(scene.surroundings.half_spaces[0].point == Vector3d(0, 0, -1));
  CHECK(scene.surroundings.half_spaces[0].normal == Vector3d(0, 1, 1));
  CHECK(scene.surroundings.half_spaces[0].velocity == Vector3d(6, 0, 0));
  CHECK(scene.surroundings.half_spaces[0].friction == 0.25);
  CHECK(scene.time_step == 0.0005);
  CHECK(scene.steps_per_frame == 8);
  CHECK(scene.frames == 77);
  CHECK(scene.merge.cut == 0.1);
  CHECK(scene.merge.node == 0.05);
  CHECK(scene.merge.edge == 0.02);
  REQUIRE(scene.cutters.size() == 1);
  CHECK(scene.cutters[0].mesh.generated.positions[2] == Vector3d(0, 1, 1));
  CHECK(scene.cutters[0].at == 0.5);
  CHECK(scene.cutters[0].interval == 0.25);
  CHECK(scene.cutters[0].times == 4);
  CHECK(scene.cutters[0].step == Vector3d(0, 0, 1));
  REQUIRE(scene.blades.size() == 1);
  CHECK(scene.blades[0].edge[1] == Vector3d(0, 0, 1));
  CHECK(scene.blades[0].axis == Vector3d(0, 1, 0));
  CHECK(scene.blades[0].keyframes[1].degrees == 30);
  const auto& output = scene.output;
  CHECK(output.width == 320);
  CHECK(output.height == 200);
  CHECK(output.picture_interval == 3);
  CHECK(output.animation_interval == 0);
  CHECK_FALSE(output.colour_pieces);
  CHECK_FALSE(output.show_physics);
  CHECK_FALSE(output.show_cutters);
  CHECK_FALSE(output.csv);
  CHECK(output.mesh == "end.ply");
  CHECK(output.view.direction == Vector3d(1, 1, -1));
  CHECK(output.view.up == Vector3d(0, 0, 1));
  CHECK(output.view.field_of_view == 0);
  CHECK(output.view_box->min() == Vector3d(-1, -1, -1));
}

TEST_CASE("what a material does not say follows from what it says") {
  const auto material = [](const std::string& keys) {
    return good(R"({"cloth": {"shape": "triangle", "corners": [[0,0,0],[1,0,0],[0,1,0]]}, "material": {)" +
                keys + "}}")
        .material;
  };
  const cut::Material stiff = material(R"("stiffness": 40, "damping": 0.8)");
  CHECK(stiff.bending_stiffness == 2);
  CHECK(stiff.bending_damping == doctest::Approx(0.04));
  const cut::Material bent = material(R"("stiffness": 40, "damping": 0.8, "bending_stiffness": 10)");
  CHECK(bent.bending_stiffness == 10);
  CHECK(bent.bending_damping == 0.2);
  CHECK(material(R"("bending_stiffness": 0)").bending_damping == 0);
  CHECK(material(R"("bending_stiffness": 0, "bending_damping": 3)").bending_damping == 3);
  CHECK(material(R"("stiffness": 0)").bending_damping == 0);
}

TEST_CASE("anchors move from keyframe to keyframe, from where the cloth is") {
  const Scene scene = good("{" + cloth + R"(, "anchors": [{"nodes": [0]}, {"box": [[0, 0, 0], [1, 0, 0]],
    "axis": [0, 2, 0], "keyframes": [{"at": 1}, {"at": 3, "move": [0, 0, 4], "degrees": 90}]}]})");
  REQUIRE(scene.anchors.size() == 2);
  CHECK(scene.anchors[0].keyframes.empty());
  const snip::Anchor& anchor = scene.anchors[1];
  const auto at = [&](double time) {
    return snip::placed(Vector3d(1, 0, 0), anchor.axis, snip::keyframe_at(anchor.keyframes, time));
  };
  CHECK(at(0) == Vector3d(1, 0, 0));
  CHECK(at(1) == Vector3d(1, 0, 0));
  CHECK(at(2).isApprox(Vector3d(std::sqrt(0.5), 0, 2 - std::sqrt(0.5))));
  CHECK(at(3).isApprox(Vector3d(0, 0, 3)));
  CHECK(at(9).isApprox(Vector3d(0, 0, 3)));
}

TEST_CASE("integrators and obstacles: names, and what is said about wrong ones") {
  CHECK(good("{" + cloth + R"(, "integrator": "implicit_euler"})").surroundings.integrator ==
        cut::Integrator::implicit_euler);
  CHECK(good("{" + cloth + R"(, "integrator": "semi_implicit_euler"})").surroundings.integrator ==
        cut::Integrator::semi_implicit_euler);
  const Scene plain = good("{" + cloth + R"(, "obstacles": [{"half_space": {}}, {"sphere": {}}]})");
  CHECK(plain.surroundings.half_spaces[0].normal == Vector3d(0, 0, 1));
  CHECK(plain.surroundings.spheres[0].radius == 1);
  CHECK(error_with(R"("normal_drag": -1)") == "s.json:3: /normal_drag: cannot be negative, is -1");
  CHECK(error_with(R"("longest_way": 0)") == "s.json:3: /longest_way: has to be greater than 0, is 0");
  CHECK(error_with("\"obstacles\": [{\"half_space\": {}},\n{\"half_space\": {\"normal\": [0, 0, 0]}}]") ==
        "s.json:4: /obstacles/1/half_space/normal: cannot be zero");
  CHECK(error_with(R"("obstacles": [{"sphere": {"radius": 0}}])") ==
        "s.json:3: /obstacles/0/sphere/radius: has to be greater than 0, is 0");
  CHECK(error_with(R"("obstacles": [{"sphere": {"friction": -0.5}}])") ==
        "s.json:3: /obstacles/0/sphere/friction: cannot be negative, is -0.5");
  CHECK(error_with(R"("obstacles": [{"half_space": {"friction": -0.5}}])") ==
        "s.json:3: /obstacles/0/half_space/friction: cannot be negative, is -0.5");
  CHECK(error_with(R"("obstacles": [{"sphere": {"center": [0, 0, 0]}}])") ==
        "s.json:3: /obstacles/0/sphere/center: unknown key \"center\"; did you mean \"centre\"?");
  CHECK(error_with(R"("obstacles": [{"sphere": {}, "half_space": {}}])") ==
        "s.json:3: /obstacles/0: only one of these keys can be given: half_space, sphere");
  CHECK(error_with(R"("obstacles": [{}])") ==
        "s.json:3: /obstacles/0: one of these keys is missing: half_space, sphere");
}

TEST_CASE("every shape can be named") {
  const auto triangles = [](const std::string& mesh) {
    return good("{\"cloth\": {\"shape\": " + mesh + "}}").cloth.generated.triangles.size();
  };
  CHECK(triangles(R"("twelve_triangles", "side": 2)") == 12);
  CHECK(triangles(R"("grid", "columns": 4, "rows": 3, "spacing": 0.1, "diagonals": "alternating")") == 24);
  CHECK(triangles(R"("hexagon", "rings": 2)") == 24);
  CHECK(triangles(R"("fan", "count": 5)") == 5);
  CHECK(triangles(R"("random_sheet", "columns": 5, "rows": 2, "seed": 9)") == 20);
  CHECK(triangles(R"("curved_sheet", "cells": 4, "height": 0)") == 32);
  CHECK(triangles(R"("sphere", "level": 1)") == 80);
  CHECK(triangles(R"("torus", "around": 5, "through": 4)") == 40);
  CHECK(triangles(R"("cylinder", "around": 5, "along": 2)") == 20);
  CHECK(triangles(R"("moebius_strip", "around": 8, "across": 2)") == 32);
  CHECK(triangles(R"("triangle", "corners": [[0,0,0],[1,0,0],[0,1,0]])") == 1);
  CHECK(triangles(R"("quad", "corners": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]])") == 2);
  CHECK(triangles(R"("plane", "centre": [0,0,0], "u": [1,0,0], "v": [0,1,0])") == 2);
  CHECK(triangles(R"("ribbon", "path": [[0,0,0],[1,0,0],[1,1,0]], "through": [0,0,1])") == 4);
  CHECK(triangles(
            R"("ribbon", "path": {"wave": {"from": [0,0,0], "to": [1,0,0], "swing": [0,1,0], "segments": 9}},
                      "through": [0,0,1])") == 18);
  CHECK(triangles(R"("tube", "path": {"circle": {"centre": [0,0,0], "u": [1,0,0], "v": [0,1,0], "count": 7}},
                      "through": [0,0,1])") == 14);
  CHECK(triangles(R"("e_shape", "foot": [0,0,0], "up": [1,0,0], "across": [0,1,0], "through": [0,0,1])") ==
        10);
  CHECK(
      triangles(R"("star", "centre": [0,0,0], "u": [1,0,0], "v": [0,1,0], "through": [0,0,1], "count": 5)") ==
      10);
  CHECK(snip::mesh_shapes().size() == 17);
}

TEST_CASE("syntax errors name line and column") {
  CHECK(error("{\n  \"cloth\": {,\n}") ==
        "s.json:2:13: not valid JSON: syntax error while parsing object key - unexpected ','; expected "
        "string literal");
  CHECK(error("").rfind("s.json:1:1: not valid JSON: ", 0) == 0);
  CHECK(error("{\"cloth\": {}").rfind("s.json:1:", 0) == 0);
  CHECK(error("{\"a\": \"\xff\xfe\"}").find("ill-formed UTF-8") != std::string::npos);
  CHECK(error("{\"a\":\n 1e999}") == "s.json:2: the number 1e999 is too large");
  CHECK(error(std::string(200000, '[')).rfind("s.json:1:", 0) == 0);
  CHECK(error(std::string(200000, '[') + std::string(200000, ']')) ==
        "s.json:1: the scene: has to be an object, not a list");
  for (int byte = 1; byte < 256; ++byte) {
    const std::string message = error(std::string(3, static_cast<char>(byte)));
    CHECK(message.rfind("s.json:", 0) == 0);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("an unknown key is named with its line; the nearest known one is suggested") {
  CHECK(error_with("\"gravty\": [0, 0, 0]") ==
        "s.json:3: /gravty: unknown key \"gravty\"; did you mean \"gravity\"?");
  CHECK(error_with("\"material\": {\n\"stifness\": 3}") ==
        "s.json:4: /material/stifness: unknown key \"stifness\"; did you mean \"stiffness\"?");
  CHECK(error_with("\"merge\": {\"zzz\": 3}") ==
        "s.json:3: /merge/zzz: unknown key \"zzz\"; known here: cut, node, edge");
  CHECK(error_of_cloth(R"("shpe": "grid", "columns": 3)") ==
        "s.json:2: /cloth/shpe: unknown key \"shpe\"; did you mean \"shape\"?");
  CHECK(error_of_cloth(R"("shape": "sphere", "level": 1, "side": 1)") ==
        "s.json:2: /cloth/side: unknown key \"side\"; known here: shape, scale, turn, move, level, radius");
  CHECK(error_with(R"("cutters": [{"blade": {"edge": [[0,0,0],[0,0,1]], "keyframe": []}}])") ==
        "s.json:3: /cutters/0/blade/keyframe: unknown key \"keyframe\"; did you mean \"keyframes\"?");
  CHECK(error_with("\"a/b~c\": 1").rfind("s.json:3: /a~1b~0c: unknown key \"a/b~c\"", 0) == 0);
  CHECK(error_with("\"a\\nb\\u0000\": 1").rfind("s.json:3: /a?b?: unknown key \"a\\nb\\u0000\"", 0) == 0);
  CHECK(error_with("\"" + std::string(100000, 'x') + "\": 1").size() < 600);
}

TEST_CASE("a key that is given twice is an error") {
  CHECK(error_with("\"frames\": 3,\n\"frames\": 4") == "s.json:4: /frames: the key is given twice");
  CHECK(error_with("\"output\": {\"width\": 1, \"height\": 2, \"wi\\u0064th\": 3}") ==
        "s.json:3: /output/width: the key is given twice");
}

TEST_CASE("a missing key is named") {
  CHECK(error("{}") == "s.json:1: the scene: the key \"cloth\" is missing");
  CHECK(error_of_cloth("") == "s.json:1: /cloth: one of these keys is missing: file, shape");
  CHECK(error_of_cloth(R"("shape": "grid", "columns": 3)") ==
        "s.json:1: /cloth: the key \"rows\" is missing");
  CHECK(error_of_cloth(R"("shape": "grid", "file": "x.obj")") ==
        "s.json:1: /cloth: only one of these keys can be given: file, shape");
}

TEST_CASE("a wrong type is named together with what was wanted") {
  CHECK(error_with("\"frames\": \"ten\"") ==
        "s.json:3: /frames: has to be a whole number, not the text \"ten\"");
  CHECK(error_with("\"frames\": 2.5") == "s.json:3: /frames: has to be a whole number, is 2.5");
  CHECK(error_with("\"time_step\": null") == "s.json:3: /time_step: has to be a number, not null");
  CHECK(error_with("\"gravity\": 9.81") ==
        "s.json:3: /gravity: has to be a list of three numbers, not a number");
  CHECK(error_with("\"gravity\": [0, 1]") == "s.json:3: /gravity: has to be a list of three numbers, has 2");
  CHECK(error_with("\"gravity\": [0,\n true, 1]") == "s.json:4: /gravity/1: has to be a number, not true");
  CHECK(error_with("\"anchors\": {}") == "s.json:3: /anchors: has to be a list, not an object");
  CHECK(error_with("\"output\": []") == "s.json:3: /output: has to be an object, not a list");
  CHECK(error_with("\"output\": {\"csv\": 1}") ==
        "s.json:3: /output/csv: has to be true or false, not a number");
  CHECK(error_with("\"description\": 1") == "s.json:3: /description: has to be a text, not a number");
  CHECK(error("{\"cloth\": 3}") == "s.json:1: /cloth: has to be an object, not a number");
}

TEST_CASE("a value out of range is named together with the range") {
  CHECK(error_with("\"time_step\": 0") == "s.json:3: /time_step: has to be greater than 0, is 0");
  CHECK(error_with("\"frames\": 0") == "s.json:3: /frames: has to be from 1 to 10000000, is 0");
  CHECK(error_with("\"frames\": -1") == "s.json:3: /frames: has to be from 1 to 10000000, is -1");
  CHECK(error_with("\"frames\": 18446744073709551615") ==
        "s.json:3: /frames: has to be from 1 to 10000000, is 18446744073709551615");
  CHECK(error_with("\"material\": {\"tear_limit\": 1}") ==
        "s.json:3: /material/tear_limit: has to be greater than 1: it is a length over the length without "
        "tension");
  CHECK(error_with("\"material\": {\"stiffness\": -2}") ==
        "s.json:3: /material/stiffness: cannot be negative, is -2");
  CHECK(error_with("\"material\": {\"bending_stiffness\": -2}") ==
        "s.json:3: /material/bending_stiffness: cannot be negative, is -2");
  CHECK(error_with(R"("anchors": [{"nodes": [0], "axis": [1, 0, 0]}])") ==
        "s.json:3: /anchors/0/axis: is what keyframes turn the anchor about, and there are none");
  CHECK(error_with(R"("anchors": [{"nodes": [0], "keyframes": [{"at": 0}, {"at": 1}]}])") ==
        "s.json:3: /anchors/0/keyframes/0/at: has to be greater than 0: at the start the anchor is where the "
        "cloth is");
  CHECK(error_with(R"("anchors": [{"nodes": [0], "keyframes": [{"at": 2}, {"at": 1}]}])") ==
        "s.json:3: /anchors/0/keyframes/1/at: has to be later than the keyframe before");
  CHECK(error_with("\"material\": {\"mass\": 1, \"density\": 1}") ==
        "s.json:3: /material: only one of density and mass can be given");
  CHECK(error_with("\"integrator\": \"forward_eular\"") ==
        "s.json:3: /integrator: unknown value \"forward_eular\"; did you mean \"forward_euler\"?");
  CHECK(error_with("\"material\": {\"mode\": \"x\"}") ==
        "s.json:3: /material/mode: unknown value \"x\"; known here: conserving, paper");
  CHECK(error_with("\"anchors\": [{\"box\": [[1, 0, 0], [0, 1, 1]]}]") ==
        "s.json:3: /anchors/0/box: the first corner has to be the lower one in x, y and z");
  CHECK(error_with("\"anchors\": [{\"nodes\": []}]") ==
        "s.json:3: /anchors/0/nodes: has to have at least 1 items, has 0");
  CHECK(error_with("\"output\": {\"camera\": {\"direction\": [0, 0, 0]}}") ==
        "s.json:3: /output/camera/direction: cannot be zero");
  CHECK(error_with("\"output\": {\"camera\": {\"field_of_view\": 170}}") ==
        "s.json:3: /output/camera/field_of_view: can be at most 120 degrees");
  CHECK(error_with("\"output\": {\"mesh\": \"../x.obj\"}") ==
        "s.json:3: /output/mesh: is the name of a file in the output folder and cannot have a slash");
  const std::string triangle = R"({"mesh": {"shape": "triangle", "corners": [[0,0,0],[1,0,0],[0,1,0]]})";
  CHECK(error_with("\"cutters\": [" + triangle + ", \"times\": 2}]") ==
        "s.json:3: /cutters/0: a cutter that cuts more than once wants an interval");
  CHECK(error_with(
            R"("cutters": [{"blade": {"edge": [[0,0,0],[0,0,1]], "keyframes": [{"at": 1}, {"at": 1}]}}])") ==
        "s.json:3: /cutters/0/blade/keyframes/1/at: has to be later than the keyframe before");
}

TEST_CASE("a name of a file cannot have the character 0 in it") {
  CHECK(error_with(R"("output": {"mesh": "a\u0000.obj"})") ==
        "s.json:3: /output/mesh: cannot have the character 0 in it");
  CHECK(error_of_cloth(R"("file": "a\u0000.obj")") ==
        "s.json:2: /cloth/file: cannot have the character 0 in it");
}

TEST_CASE("lines of values are found in any layout") {
  const auto lines = snip::json_lines("{\"a\":1,\n\"b\" :\n[ 2 ,\n{\"c\\\"}\": null}\n,\"]\", -1e3,true]\n}");
  const auto line = [&](const char* pointer) { return lines.line_of.at(pointer); };
  CHECK(line("") == 1);
  CHECK(line("/a") == 1);
  CHECK(line("/b") == 2);
  CHECK(line("/b/0") == 3);
  CHECK(line("/b/1") == 4);
  CHECK(line("/b/1/c\"}") == 4);
  CHECK(line("/b/2") == 5);
  CHECK(line("/b/3") == 5);
  CHECK(line("/b/4") == 5);
  CHECK(lines.line_of.size() == 9);
  CHECK(lines.repeated_key.empty());
}

TEST_CASE("blades move from keyframe to keyframe") {
  snip::MovingBlade blade;
  blade.edge = {{1, 0, 0}, {1, 0, 1}};
  blade.keyframes = {{1, {0, 0, 0}, 0}, {3, {4, 0, 0}, 0}, {4, {4, 0, 0}, 90}};
  CHECK(snip::blade_at(blade, 0) == blade.edge);
  CHECK(snip::blade_at(blade, 1) == blade.edge);
  CHECK(snip::blade_at(blade, 1.5)[1].isApprox(Vector3d(2, 0, 1)));
  CHECK(snip::blade_at(blade, 3)[0].isApprox(Vector3d(5, 0, 0)));
  CHECK(snip::blade_at(blade, 4)[1].isApprox(Vector3d(4, 1, 1)));
  CHECK(snip::blade_at(blade, 9)[1].isApprox(Vector3d(4, 1, 1)));
  CHECK_FALSE(snip::blade_moves_between(blade, 0, 1));
  CHECK(snip::blade_moves_between(blade, 0.9, 1.1));
  CHECK(snip::blade_moves_between(blade, 3.9, 4.1));
  CHECK_FALSE(snip::blade_moves_between(blade, 4, 5));
}

TEST_CASE("a cutter is due once in each of its frames, wherever frames begin") {
  snip::StaticCutter cutter;
  cutter.at = 0.3;
  cutter.interval = 0.1;
  cutter.times = 50;
  for (const double frame : {0.02, 0.1, 0.07, 1.0, 30.0}) {
    std::vector<std::size_t> seen;
    for (int i = 0; i * frame < 40; ++i)
      for (const std::size_t repetition : snip::repetitions_between(cutter, i * frame, (i + 1) * frame))
        seen.push_back(repetition);
    REQUIRE(seen.size() == 50);
    for (std::size_t i = 0; i < 50; ++i) CHECK(seen[i] == i);
  }
  cutter = {};
  CHECK(snip::repetitions_between(cutter, 0, 0.1) == std::vector<std::size_t>{0});
  CHECK(snip::repetitions_between(cutter, 0.1, 0.2).empty());
}

TEST_CASE("the documentation names every shape and its keys, and its samples are scenes") {
  const std::string page = file_text("docs/scene_file.md");
  for (const auto& shape : snip::mesh_shapes()) {
    const std::size_t row = page.find(fmt::format("| `{}` |", shape.name));
    REQUIRE_MESSAGE(row != std::string::npos, shape.name);
    const std::string line = page.substr(row, page.find('\n', row) - row);
    for (const auto& key : shape.keys)
      CHECK_MESSAGE(line.find(fmt::format("`{}`", key)) != std::string::npos, key);
  }
  std::size_t samples = 0;
  for (std::size_t at = page.find("```json\n"); at != std::string::npos;
       at = page.find("```json\n", at + 1)) {
    const std::size_t start = at + 8;
    good(page.substr(start, page.find("```", start) - start));
    ++samples;
  }
  CHECK(samples > 0);
}

TEST_CASE("the documentation lists every key that an error message can offer") {
  const std::string page = file_text("docs/scene_file.md");
  const std::string triangle = R"("mesh": {"shape": "triangle", "corners": [[0,0,0],[1,0,0],[0,1,0]]})";
  for (const std::string& object :
       {std::string(R"("zzzzzz": 1)"), std::string(R"("material": {"zzzzzz": 1})"),
        std::string(R"("merge": {"zzzzzz": 1})"), std::string(R"("anchors": [{"zzzzzz": 1, "nodes": [1]}])"),
        "\"cutters\": [{\"zzzzzz\": 1, " + triangle + "}]",
        std::string(R"("cutters": [{"blade": {"zzzzzz": 1}}])"),
        std::string(
            R"("cutters": [{"blade": {"edge": [[0,0,0],[0,0,1]], "keyframes": [{"zzzzzz": 1}, {}]}}])"),
        std::string(R"("obstacles": [{"sphere": {"zzzzzz": 1}}])"),
        std::string(R"("obstacles": [{"half_space": {"zzzzzz": 1}}])"),
        std::string(R"("obstacles": [{"zzzzzz": 1, "sphere": {}}])"),
        std::string(R"("output": {"zzzzzz": 1})"), std::string(R"("output": {"camera": {"zzzzzz": 1}})")}) {
    std::string message = error_with(object);
    const std::size_t start = message.find("known here: ");
    REQUIRE_MESSAGE(start != std::string::npos, message);
    std::istringstream keys(message.substr(start + 12));
    for (std::string key; std::getline(keys, key, ',');) {
      key.erase(0, key.find_first_not_of(' '));
      CHECK_MESSAGE(page.find(fmt::format("| `{}` |", key)) != std::string::npos, key);
    }
  }
}

TEST_CASE("the scenes of the repository can be read") {
  for (const char* name : {"incremental", "e_shape", "e_shape_paper", "moving_edge"}) {
    const auto scene = snip::read_scene(std::string(SNIP_SOURCE_DIR) + "/examples/scenes/" + name + ".json");
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    CHECK(scene->cloth.generated.triangles.size() == 12);
  }
  const auto missing = snip::read_scene("no/such/scene.json");
  REQUIRE_FALSE(missing);
  CHECK(missing.error().message.find("no/such/scene.json") != std::string::npos);
}
