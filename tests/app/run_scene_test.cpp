// Scenes in motion: the three experiments of the paper (§6, Figure 8), anchors, mistakes, and what a run
// writes.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>
#include <string>

#include "cut/bending.hpp"
#include "cut/validate.hpp"
#include "snip/mesh_file/mesh_file.hpp"
#include "snip/pieces.hpp"
#include "snip/run/run.hpp"
#include "snip/run/scene_file.hpp"
#include "snip/run/scene_picture.hpp"
#include "snip/run/scene_run.hpp"

namespace fs = std::filesystem;
using snip::Scene;
using snip::SceneRun;

namespace {

const fs::path scenes_folder = fs::path(SNIP_SOURCE_DIR) / "examples/scenes";

/// A folder of this test's own, removed at its end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("snip_run_" + std::to_string(::getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return path / name;
  }
};

Scene scene_of(const std::string& text) {
  auto scene = snip::parse_scene(text, "s.json");
  REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
  return *scene;
}

SceneRun start(const Scene& scene, const fs::path& folder = ".") {
  auto run = SceneRun::start(scene, folder);
  REQUIRE_MESSAGE(run, (run ? "" : run.error().message));
  return std::move(*run);
}

/// All frames; the mesh has to be sound after each.
void finish(SceneRun& run) {
  while (run.frame().number < run.scene().frames) {
    const auto advanced = run.advance();
    REQUIRE_MESSAGE(advanced, (advanced ? "" : advanced.error().message));
    for (const cut::Violation& violation : cut::validate(run.mesh(), 3))
      FAIL_CHECK(violation.rule, violation.message);
  }
}

Scene experiment(const std::string& name) {
  auto scene = snip::read_scene(scenes_folder / (name + ".json"));
  REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
  return *scene;
}

/// The lowest point of each piece, largest piece first.
std::vector<double> lowest_points(const SceneRun& run) {
  std::vector<double> lowest(run.pieces().list.size(), 1e9);
  const auto& vertices = run.mesh().buffers.render_vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (vertices[v].triangle.valid())
      lowest[run.pieces().of_vertex[v]] =
          std::min(lowest[run.pieces().of_vertex[v]], run.mesh().position(vertices[v]).z());
  return lowest;
}

/// The largest angle [degrees] by which two physics triangles are folded at an edge that they share.
double sharpest_fold(const SceneRun& run) {
  const cut::HybridMesh& mesh = run.mesh();
  double sharpest = 0;
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e)
    for (const cut::BendingPair& pair : cut::bending_pairs(mesh, cut::AncestorEdgeId{e})) {
      std::array<Eigen::Vector3d, 2> normals;
      for (std::size_t side = 0; side < 2; ++side) {
        const auto& nodes = mesh.buffers.triangles[pair.fragments[side].index()].nodes;
        const auto at = [&](std::size_t i) { return mesh.positions[nodes[i].index()]; };
        normals[side] = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      }
      sharpest = std::max(sharpest, std::acos(std::clamp(normals[0].dot(normals[1]), -1.0, 1.0)));
    }
  return sharpest * 180 / std::numbers::pi;
}

double rendered_area(const SceneRun& run) {
  double sum = 0;
  for (const auto& piece : run.pieces().list) sum += piece.rest_area;
  return sum;
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  REQUIRE_MESSAGE(file, path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

const std::string sheet = R"("cloth": {"shape": "grid", "columns": 4, "rows": 4, "spacing": 0.25},
  "anchors": [{"box": [[0, 0, 0], [0, 1, 0]]}, {"box": [[1, 0, 0], [1, 1, 0]]}])";
const std::string cut_across = R"("cutters": [{"at": 0.1, "mesh":
  {"shape": "plane", "centre": [0.6, 0.5, 0], "u": [0.03, 2, 0], "v": [0, 0, 1]}}])";

}  // namespace

TEST_CASE("experiment 1: incremental cutting separates the patch in the end") {
  SceneRun run = start(experiment("incremental"));
  const double mass = run.simulation().total_mass(), area = rendered_area(run);

  while (run.frame().number < 30) REQUIRE(run.advance());
  CHECK(run.frame().pieces == 1);
  CHECK(run.mesh().topology_version == 1);
  finish(run);
  CHECK(run.frame().pieces == 2);
  CHECK(run.frame().physics_triangles > 12);
  CHECK(run.simulation().total_mass() == doctest::Approx(mass).epsilon(1e-12));
  CHECK(rendered_area(run) == doctest::Approx(area).epsilon(1e-12));
  for (const auto& piece : run.pieces().list) CHECK(piece.euler_characteristic == 1);
}

TEST_CASE("experiment 1 with bending springs: nothing folds as sharply") {
  const auto sharpest = [](double bending_stiffness) {
    Scene scene = experiment("incremental");
    scene.material.bending_stiffness = bending_stiffness;
    SceneRun run = start(scene);
    double result = 0;
    while (run.frame().number < scene.frames) {
      REQUIRE(run.advance());
      result = std::max(result, sharpest_fold(run));
    }
    return result;
  };
  // docs/experiments.md states these.
  CHECK(sharpest(0) == doctest::Approx(179).epsilon(0.01));
  CHECK(sharpest(10) == doctest::Approx(95).epsilon(0.02));
  CHECK(sharpest(40) == doctest::Approx(80).epsilon(0.02));
}

TEST_CASE("experiment 2: the E cuts two pieces out, and they fall") {
  SceneRun run = start(experiment("e_shape"));
  const double mass = run.simulation().total_mass();
  CHECK(run.cutter_meshes().front().triangles.size() == 10);
  finish(run);
  REQUIRE(run.frame().pieces == 3);
  CHECK(run.simulation().total_mass() == doctest::Approx(mass).epsilon(1e-12));
  const auto lowest = lowest_points(run);
  CHECK(lowest[0] > -1);
  CHECK(lowest[1] < -4);
  CHECK(lowest[2] < -4);
}

TEST_CASE("experiment 2 in paper mode: copied anchors hold the pieces up, and mass appears") {
  SceneRun run = start(experiment("e_shape_paper"));
  const double mass = run.simulation().total_mass();
  finish(run);
  REQUIRE(run.frame().pieces == 3);
  CHECK(run.simulation().total_mass() > 1.2 * mass);
  for (const double lowest : lowest_points(run)) CHECK(lowest > -3);
}

TEST_CASE("experiment 3: the moving edge separates the patch") {
  SceneRun run = start(experiment("moving_edge"));
  finish(run);
  CHECK(run.frame().pieces == 2);
  CHECK(run.mesh().topology_version > 10);
}

TEST_CASE("an overstretched cloth tears; without a limit the same cloth holds") {
  Scene scene = experiment("tearing");
  scene.frames = 40;
  scene.output.picture_interval = 0;
  SceneRun torn = start(scene);
  finish(torn);
  REQUIRE(torn.pieces().list.size() > 1);
  CHECK(rendered_area(torn) == doctest::Approx(1.44));
  CHECK(lowest_points(torn)[0] < -0.6);  // the largest piece falls

  scene.tear_limit = 0;
  SceneRun whole = start(scene);
  finish(whole);
  CHECK(whole.pieces().list.size() == 1);
}

TEST_CASE("a run is the same to the bit each time") {
  SceneRun first = start(experiment("moving_edge")), second = start(experiment("moving_edge"));
  finish(first);
  finish(second);
  CHECK(first.mesh().positions == second.mesh().positions);
  CHECK(first.mesh().buffers == second.mesh().buffers);
  CHECK(first.frame().energy.total() == second.frame().energy.total());
}

TEST_CASE("without cutters nothing is cut; anchored nodes keep their place and the others fall") {
  SceneRun run = start(scene_of("{" + sheet + ", \"frames\": 8}"));
  const auto before = run.mesh().positions;
  finish(run);
  CHECK(run.frame().time == doctest::Approx(0.16));
  CHECK(run.frame().pieces == 1);
  CHECK(run.mesh().topology_version == 0);
  for (std::size_t n = 0; n < before.size(); ++n) {
    const bool held = before[n].x() == 0 || before[n].x() == 1;
    CHECK(run.simulation().anchored(cut::NodeId{n}) == held);
    CHECK((run.mesh().positions[n] == before[n]) == held);
    if (!held) CHECK(run.mesh().positions[n].z() < 0);
  }
}

TEST_CASE("moving anchors take their nodes and all anchored copies along") {
  // The right border waits, turns about y while it moves up, and stays; it is cut in two after a while.
  SceneRun run = start(scene_of(R"({"cloth": {"shape": "grid", "columns": 4, "rows": 4, "spacing": 0.25},
    "anchors": [{"box": [[0, 0, 0], [0, 1, 0]]}, {"box": [[1, 0, 0], [1, 1, 0]], "axis": [0, 1, 0],
      "keyframes": [{"at": 0.1}, {"at": 0.5, "move": [0, 0, 0.5], "degrees": 30}]}],
    "cutters": [{"at": 0.3, "mesh": {"shape": "plane", "centre": [0.5, 0.6, 0], "u": [4, 0, 0], "v": [0, 0, 4]}}],
    "frames": 40})"));
  const auto& keyframes = run.scene().anchors[1].keyframes;
  std::size_t moved = 0;
  while (run.frame().number < run.scene().frames) {
    REQUIRE(run.advance());
    const cut::HybridMesh& mesh = run.mesh();
    moved = 0;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      if (!run.simulation().anchored(cut::NodeId{n})) continue;
      const Eigen::Vector3d& rest = mesh.ancestors.rest_positions[mesh.buffers.nodes[n].index()];
      moved += rest.x() == 1;
      const Eigen::Vector3d wanted =
          rest.x() == 1 ? snip::placed(rest, {0, 1, 0}, snip::keyframe_at(keyframes, run.frame().time))
                        : rest;
      CHECK((mesh.positions[n] - wanted).norm() < 1e-12);
    }
  }
  CHECK(run.frame().pieces == 2);
  CHECK(moved == 5);
  CHECK(run.mesh().positions[4].isApprox(Eigen::Vector3d(std::sqrt(0.75), 0, 0), 1e-9));
}

TEST_CASE("moving anchors: two for a node, and one that is too fast, are named") {
  const auto message = [](const std::string& anchors) {
    auto run = SceneRun::start(scene_of(R"({"cloth": {"shape": "grid", "columns": 2, "rows": 2},)"
                                        "\n\"anchors\": [" +
                                        anchors + "]}"),
                               ".");
    if (!run) return run.error().message;
    SceneRun going = std::move(*run);
    const auto advanced = going.advance();
    return advanced ? "no error" : advanced.error().message;
  };
  const std::string up = R"("keyframes": [{"at": 1, "move": [0, 0, 1]}]})";
  CHECK(message(R"({"nodes": [1, 2]}, {"nodes": [2, 3]})") == "no error");
  CHECK(message(R"({"nodes": [1, 2]}, {"nodes": [3], )" + up) == "no error");
  CHECK(message(R"({"nodes": [1, 2]}, {"nodes": [2, 3], )" + up) ==
        "s.json:2: /anchors/1: node 2 has an anchor already, and one of the two moves");
  CHECK(message(R"({"nodes": [1, 2], "keyframes": [{"at": 1e-4, "move": [0, 100, 0]}]})") ==
        "frame 1 (0 s): s.json:2: /anchors/0: it takes node 1 further in a time step of 0.001 s than "
        "longest_way, 2.83 m");
}

TEST_CASE("mass and density say the same in two ways") {
  const auto mass = [](const std::string& material) {
    return start(scene_of("{" + sheet + ", \"material\": {" + material + "}}")).simulation().total_mass();
  };
  CHECK(mass("\"mass\": 3") == doctest::Approx(3));
  CHECK(mass("\"density\": 0.5") == doctest::Approx(0.5));
  CHECK(mass("\"mass\": 0.5") == doctest::Approx(mass("\"density\": 0.5")));
}

TEST_CASE("a placed cloth is measured and held where it was placed") {
  const Scene scene = scene_of(R"({"cloth": {"shape": "grid", "columns": 2, "rows": 2, "scale": 2,
    "turn": {"axis": [1, 0, 0], "degrees": 90}, "move": [10, 0, 0]},
    "anchors": [{"box": [[10, -0.1, 3.9], [14, 0.1, 4.1]]}], "material": {"density": 1}})");
  const SceneRun run = start(scene);
  CHECK(run.simulation().total_mass() == doctest::Approx(16));
  for (std::size_t n = 0; n < 9; ++n) CHECK(run.simulation().anchored(cut::NodeId{n}) == (n >= 6));
}

TEST_CASE("pieces keep their colour; the largest part of a piece inherits it") {
  SceneRun run = start(scene_of("{" + sheet + ", " + cut_across + R"(, "frames": 30})"));
  CHECK(run.colours().of(cut::TriangleId{0}) == 0);
  finish(run);
  REQUIRE(run.frame().pieces == 2);
  const auto& triangles = run.mesh().buffers.render_triangles;
  std::vector<std::set<std::size_t>> colours(2);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (triangles[t].triangle.valid())
      colours[run.pieces().of_triangle[t]].insert(run.colours().of(triangles[t].triangle));
  CHECK(colours[0] == std::set<std::size_t>{0});
  CHECK(colours[1] == std::set<std::size_t>{1});
}

TEST_CASE("merge distances come from the scene; wrong ones are named with their place") {
  const auto message = [](const std::string& merge) {
    const auto run = SceneRun::start(scene_of("{" + sheet + ",\n\"merge\": {" + merge + "}}"), ".");
    return run ? "" : run.error().message;
  };
  CHECK(message(R"("cut": 0.03, "node": 0.02, "edge": 0.01)").empty());
  CHECK(message(R"("edge": 0.2)").empty());
  CHECK(message(R"("cut": 0.0001)").empty());
  CHECK(message(R"("cut": 0.01, "node": 0.02)").rfind("s.json:3: /merge: ", 0) == 0);
  CHECK(message(R"("edge": 1e-12)").rfind("s.json:3: /merge: ", 0) == 0);
}

TEST_CASE("anchors that hold nothing, and files that are not there, are errors") {
  const auto message = [](const std::string& text) {
    const auto run = SceneRun::start(scene_of(text), "no/such/folder");
    return run ? "no error" : run.error().message;
  };
  const std::string cloth = R"("cloth": {"shape": "fan", "count": 5})";
  CHECK(message("{" + cloth + ",\n\"anchors\": [{\"nodes\": [6]}]}") ==
        "s.json:2: /anchors/0: there is no node 6: the cloth has 6 nodes");
  CHECK(message("{" + cloth + ",\n\"anchors\": [{\"nodes\": [0]}, {\"box\": [[2, 2, 2], [3, 3, 3]]}]}") ==
        "s.json:2: /anchors/1: no node of the cloth is there");
  CHECK(message("{\n\"cloth\": {\"file\": \"x.obj\"}}") ==
        "s.json:2: /cloth: no/such/folder/x.obj: no such file");
  CHECK(message("{" + cloth + R"(, "cutters": [{"mesh": {"file": "y.ply"}}]})") ==
        "s.json:1: /cutters/0/mesh: no/such/folder/y.ply: no such file");
}

TEST_CASE("meshes are found beside the scene") {
  const Folder folder;
  (void)folder.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  (void)folder.write("cutter.off", "OFF\n3 1 0\n0.5 -9 -1\n0.5 9 -1\n0.5 0 9\n3 0 1 2\n");
  const Scene scene = scene_of(R"({"cloth": {"file": "cloth.obj"}, "gravity": [0, 0, 0], "frames": 1,
    "cutters": [{"mesh": {"file": "cutter.off"}}]})");
  SceneRun run = start(scene, folder.path);
  finish(run);
  CHECK(run.frame().pieces == 2);
}

TEST_CASE("the mesh at the end has the UV of the cloth, and no normals, which would be those of the start") {
  const Folder folder;
  (void)folder.write("cloth.obj",
                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0.5 0\nvt 1 0\nvt 0 1\nf 1/1/1 2/2/1 3/3/1\n");
  const fs::path scene = folder.write("s.json", R"({"cloth": {"file": "cloth.obj", "scale": 3,
    "turn": {"axis": [1, 0, 0], "degrees": 90}}, "frames": 2})");
  REQUIRE(snip::run_scene({scene, folder.path / "out", {}, true}));
  const auto mesh = snip::read_mesh(folder.path / "out/final.obj");
  REQUIRE(mesh);
  CHECK(mesh->uvs == std::vector<Eigen::Vector2d>{{0.5, 0}, {1, 0}, {0, 1}});
  CHECK(mesh->normals.empty());
}

TEST_CASE("a run writes what the scene asks for") {
  const Folder folder;
  const fs::path scene = folder.write("s.json", "{" + sheet + ", " + cut_across + R"(, "frames": 12,
    "output": {"width": 60, "height": 40, "picture_interval": 5, "animation_interval": 3, "mesh": "end.ply"}})");
  REQUIRE(snip::run_scene({scene, folder.path / "out", {}, false}));
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path / "out"))
    names.insert(entry.path().filename().string());
  CHECK(names == std::set<std::string>{"animation.webp", "end.ply", "frame_00000.png", "frame_00005.png",
                                       "frame_00010.png", "frame_00012.png", "frames.csv"});
  const auto lines = lines_of(text_of(folder.path / "out/frames.csv"));
  REQUIRE(lines.size() == 14);
  CHECK(lines[0] ==
        "frame,time_s,pieces,physics_nodes,physics_edges,physics_triangles,render_nodes,render_triangles,"
        "kinetic_j,elastic_j,gravity_j,total_j,cut_ms,simulation_ms");
  CHECK(lines[1].rfind("0,0,1,25,56,32,25,32,0,0,0,0,", 0) == 0);
  CHECK(lines[13].rfind("12,0.24,2,", 0) == 0);
  for (const std::string& line : lines) CHECK(std::count(line.begin(), line.end(), ',') == 13);
  const auto mesh = snip::read_mesh(folder.path / "out/end.ply");
  REQUIRE(mesh);
  CHECK(snip::find_pieces(mesh->positions, mesh->triangles).pieces.size() == 2);
}

TEST_CASE("fewer frames and no images on demand") {
  const Folder folder;
  const fs::path scene = folder.write("s.json", "{" + sheet + "}");
  REQUIRE(snip::run_scene({scene, folder.path / "a/b", 3, true}));
  CHECK(lines_of(text_of(folder.path / "a/b/frames.csv")).size() == 5);
  CHECK(fs::exists(folder.path / "a/b/final.obj"));
  CHECK_FALSE(fs::exists(folder.path / "a/b/animation.webp"));
  CHECK_FALSE(fs::exists(folder.path / "a/b/frame_00000.png"));
}

TEST_CASE("a run that blows up says so, and leaves what there is up to the last good frame") {
  const Folder folder;
  const std::string stiff =
      R"(, "material": {"stiffness": 1e6}, "time_step": 0.01, "frames": 50, "output": {"width": 40, "height": 30}})";
  const Scene scene = scene_of("{" + sheet + stiff);
  CHECK(start(scene).warning().find("time step") != std::string::npos);
  const auto ran =
      snip::run_scene({folder.write("s.json", "{" + sheet + stiff), folder.path / "out", {}, false});
  REQUIRE_FALSE(ran);
  CHECK(ran.error().message.rfind("frame ", 0) == 0);
  CHECK(ran.error().message.find("the simulation blew up in step ") != std::string::npos);
  CHECK(ran.error().message.find("the time step of 0.01 s is more than the ") != std::string::npos);
  const auto lines = lines_of(text_of(folder.path / "out/frames.csv"));
  CHECK(lines.size() >= 2);
  CHECK(lines.size() < 52);
  CHECK(snip::read_mesh(folder.path / "out/final.obj"));
  CHECK(fs::exists(folder.path / "out/animation.webp"));
}

TEST_CASE("a run that blows up in small steps blames the forces") {
  SceneRun run = start(scene_of("{" + sheet + R"(, "gravity": [1e30, 0, 0]})"));
  const auto advanced = run.advance();
  REQUIRE_FALSE(advanced);
  CHECK(advanced.error().message.find(": the forces are too large") != std::string::npos);
}

TEST_CASE("what falls further in a step than the longest way is told so") {
  Scene scene = scene_of(R"({"cloth": {"shape": "grid", "columns": 2, "rows": 2, "spacing": 0.05},
    "integrator": "implicit_euler", "time_step": 0.016, "steps_per_frame": 1, "frames": 100})");
  const auto run_on = [](SceneRun run) {
    snip::Result<> advanced;
    while ((advanced = run.advance()) && run.frame().number < 99) continue;
    return advanced;
  };
  const snip::Result<> advanced = run_on(start(scene));
  REQUIRE_FALSE(advanced);
  CHECK_MESSAGE(advanced.error().message.find("for a time step of 0.016 s: it goes further in one than "
                                              "longest_way, 0.141 m") != std::string::npos,
                advanced.error().message);
  scene.surroundings.longest_way = 0.3;
  CHECK(run_on(start(scene)));
}

TEST_CASE("a time step that is too large only after a cut is told of then, once") {
  // A slit along physics edges, with the border held: in paper mode its ends get a spring more and no mass.
  const std::string text = R"({"cloth": {"shape": "grid", "columns": 4, "rows": 4},
    "anchors": [{"nodes": [0, 1, 2, 3, 4, 5, 9, 10, 14, 15, 19, 20, 21, 22, 23, 24]}],
    "cutters": [{"at": 0.1, "mesh": {"shape": "plane", "centre": [2, 2, 0], "u": [2.4, 0, 0], "v": [0, 0, 1]}}],
    "gravity": [0, 0, 0], "frames": 12, "material": {"mode": "paper"}, "time_step": )";
  SceneRun probe = start(scene_of(text + "0.001}"));
  const auto stable = [&] {
    return probe.simulation().stable_time_step(cut::Integrator::semi_implicit_euler);
  };
  const double before = stable();
  finish(probe);
  const double after = stable();
  REQUIRE(after < before);
  CHECK(probe.warning().empty());

  const double between = (after + before) / 2;
  SceneRun run = start(scene_of(text + fmt::format("{}}}", between)));
  CHECK(run.warning().empty());
  finish(run);
  CHECK_MESSAGE(run.warning().starts_with("after the cuts of frame "), run.warning());
  CHECK(run.warning().find(fmt::format("the {:.3g} s up to which", after)) != std::string::npos);

  Scene implicit = scene_of(text + fmt::format("{}}}", between));
  implicit.surroundings.integrator = cut::Integrator::implicit_euler;
  SceneRun without = start(implicit);
  finish(without);
  CHECK(without.warning().empty());
}

TEST_CASE("a step that fails is named, counted from the start of the run, and so is its node") {
  SceneRun run = start(scene_of("{" + sheet + R"(, "material": {"stiffness": 1e6}, "time_step": 0.01})"));
  snip::Result<> advanced;
  while ((advanced = run.advance())) continue;
  const std::string where = fmt::format(" in step {} at node ", run.simulation().updates() + 1);
  CHECK_MESSAGE(advanced.error().message.find(where) != std::string::npos, advanced.error().message);
}

TEST_CASE("an implicit step without a solution says which, and what helps") {
  Scene scene =
      scene_of("{" + sheet + R"(, "integrator": "implicit_euler", "material": {"stiffness": 1e4}})");
  scene.surroundings.most_iterations = 1;
  SceneRun run = start(scene);
  snip::Result<> advanced;
  while ((advanced = run.advance()) && run.frame().number < 9) continue;
  REQUIRE_FALSE(advanced);
  const std::string step = fmt::format("the implicit step {} found no velo", run.simulation().updates() + 1);
  CHECK_MESSAGE(advanced.error().message.find(step) != std::string::npos, advanced.error().message);
  CHECK(advanced.error().message.find("a smaller time_step") != std::string::npos);
}

TEST_CASE("stiff cloth falls over a ball onto a floor at frame rate, and is cut there") {
  SceneRun run = start(scene_of(R"({"cloth": {"shape": "grid", "columns": 8, "rows": 8, "spacing": 0.125},
    "material": {"stiffness": 5000, "damping": 1}, "integrator": "implicit_euler", "normal_drag": 0.2,
    "time_step": 0.016, "steps_per_frame": 1, "frames": 60, "obstacles": [
      {"half_space": {"point": [0, 0, -0.5], "friction": 0.4}},
      {"sphere": {"centre": [0.5, 0.5, -0.3], "radius": 0.25, "friction": 0.4}}],
    "cutters": [{"at": 0.5, "mesh":
      {"shape": "plane", "centre": [0.22, 0.5, -0.3], "u": [0.02, 3, 0], "v": [0, 0, 2]}}]})"));
  CHECK(run.warning().empty());
  finish(run);
  CHECK(run.frame().pieces == 2);
  const Eigen::Vector3d middle(0.5, 0.5, -0.3);
  double lowest = 1;
  for (const Eigen::Vector3d& p : run.mesh().positions) {
    CHECK((p - middle).norm() > 0.25 - 1e-6);
    CHECK(p.z() > -0.5 - 1e-6);
    lowest = std::min(lowest, p.z());
  }
  CHECK(lowest < -0.499);
}

TEST_CASE("an obstacle that moves too fast for the cloth is named with its place") {
  const auto message = [](const std::string& obstacle) {
    const auto run = SceneRun::start(scene_of("{" + sheet + ",\n\"obstacles\": [" + obstacle + "]}"), ".");
    return run ? "no error" : run.error().message;
  };
  CHECK(message(R"({"sphere": {"centre": [0, 0, -9], "velocity": [0, 0, 1400]}})") == "no error");
  CHECK(message(R"({"half_space": {"point": [0, 0, -9]}}, {"sphere": {"velocity": [0, 0, -1500]}})")
            .rfind("s.json:3: /obstacles/1/sphere: the velocity takes it further", 0) == 0);
  CHECK(message(R"({"half_space": {"velocity": [0, 1500, 0]}})")
            .rfind("s.json:3: /obstacles/0/half_space: the velocity takes it further", 0) == 0);
}

TEST_CASE("a folder that cannot be made is an error") {
  const Folder folder;
  const fs::path scene = folder.write("s.json", "{" + sheet + "}");
  const auto ran = snip::run_scene({scene, scene / "out", 1, true});
  REQUIRE_FALSE(ran);
  CHECK(ran.error().message.find("cannot be made") != std::string::npos);
}

TEST_CASE("a generated cloth that cannot be cut is named with its place, and no file is spoken of") {
  const auto run = SceneRun::start(
      scene_of("{\n"
               R"("cloth": {"shape": "plane", "centre": [0, 0, 0], "u": [1, 0, 0], "v": [2, 0, 0]}})"),
      ".");
  REQUIRE_FALSE(run);
  CHECK(run.error().message == "s.json:2: /cloth: triangle 0 has no area");
}

TEST_CASE("a picture shows physics, anchors, cuts and cutters, unless they are switched off") {
  Scene scene = scene_of("{" + sheet + ", " + cut_across + ", \"frames\": 6}");
  SceneRun run = start(scene);
  finish(run);
  const snip::Drawing all = snip::scene_drawing(run, 30);
  CHECK(all.surface.triangles.size() == run.frame().render_triangles);
  CHECK(all.lines.size() > run.frame().physics_edges);
  CHECK(all.dots.size() == run.frame().physics_nodes);
  CHECK(all.panes.size() == 2);
  const snip::Drawing fine = snip::scene_drawing(run, 3);
  CHECK(fine.dots.size() == 10);
  CHECK(fine.lines.front().width < all.lines.front().width);
  scene.output.show_physics = scene.output.show_cutters = false;
  SceneRun plain = start(scene);
  finish(plain);
  const snip::Drawing less = snip::scene_drawing(plain, 30);
  CHECK(less.lines.empty());
  CHECK(less.dots.empty());
  CHECK(less.panes.empty());
}

TEST_CASE("a picture shows obstacles where they are") {
  SceneRun run = start(scene_of("{" + sheet + R"(, "gravity": [0, 0, 0], "frames": 5, "obstacles": [
    {"sphere": {"centre": [0, 0, 9], "radius": 0.5, "velocity": [10, 0, 0]}},
    {"half_space": {"point": [7, 7, -3], "normal": [0, 0, 2]}}]})"));
  finish(run);
  const snip::Surface surface = snip::scene_drawing(run, 30).surface;
  CHECK(surface.colours.size() == surface.triangles.size());
  Eigen::AlignedBox3d ball, floor;
  for (const Eigen::Vector3d& p : surface.positions) {
    if (p.z() > 5) ball.extend(p);
    if (p.z() < -2) floor.extend(p);
  }
  CHECK(ball.center().isApprox(Eigen::Vector3d(1, 0, 9), 1e-3));
  CHECK(ball.sizes().isApprox(Eigen::Vector3d::Ones(), 0.03));
  CHECK(floor.contains(Eigen::Vector3d(0, 0, floor.min().z())));
  CHECK(floor.contains(Eigen::Vector3d(1, 1, floor.min().z())));
  CHECK(floor.sizes().z() == 0);
  CHECK(std::abs(floor.min().z() + 3) < 0.02);
}

TEST_CASE("cuts are drawn on the lips of the cloth, wherever it has moved") {
  // A slit within one triangle, and a cut along a physics edge: each point drawn lies on the render mesh.
  Scene scene = scene_of("{" + sheet + R"(, "frames": 5, "cutters": [
    {"mesh": {"shape": "plane", "centre": [0.35, 0.3, 0], "u": [0.04, 0.02, 0], "v": [0, 0, 1]}},
    {"mesh": {"shape": "plane", "centre": [0.5, 0.5, 0], "u": [0.2, 0, 0], "v": [0, 0, 1]}}]})");
  SceneRun run = start(scene);
  finish(run);
  std::size_t cuts = 0;
  for (const snip::Line& line : snip::scene_drawing(run, 30).lines) {
    if (line.colour.r < 100) continue;
    ++cuts;
    const double x = (line.from.x() + line.to.x()) / 2, y = (line.from.y() + line.to.y()) / 2;
    const bool on_slit = std::abs(x - 0.35) < 0.05 && std::abs(y - 0.3) < 0.05;
    const bool on_edge = std::abs(x - 0.5) < 0.15 && std::abs(y - 0.5) < 0.05;
    CHECK((on_slit || on_edge));
  }
  CHECK(cuts >= 3);
}
