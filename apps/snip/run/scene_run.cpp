// A scene in motion, see scene_run.hpp.
#include "snip/run/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cut/tearing.hpp>
#include <numeric>
#include <scenes/cutters.hpp>
#include <utility>

#include "snip/clean.hpp"
#include "snip/commands/report.hpp"
#include "snip/run/json_reader.hpp"

namespace snip {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The mesh of a source, where the scene puts it. It will move, so normals would soon be wrong.
Result<Mesh> load(const MeshSource& source, const std::filesystem::path& folder) {
  Mesh mesh;
  if (!source.file.empty()) {
    auto read = read_clean_mesh(folder / source.file);
    if (!read) return Error{fmt::format("{}: {}", source.place, read.error().message)};
    mesh = std::move(*read);
    mesh.normals.clear();
    mesh.normal_triangles.clear();
  } else {
    mesh.positions = source.generated.positions;
    mesh.triangles = source.generated.triangles;
    mesh.polygon_count = mesh.triangles.size();
    mesh.polygon_of_triangle.resize(mesh.triangles.size());
    std::iota(mesh.polygon_of_triangle.begin(), mesh.polygon_of_triangle.end(), 0u);
  }
  for (Eigen::Vector3d& p : mesh.positions) {
    p = source.placement * p;
    if (!(p.cwiseAbs().maxCoeff() < cut::largest_coordinate))
      return Error{fmt::format("{}: the mesh has a coordinate of {} or more where it is put", source.place,
                               cut::largest_coordinate)};
  }
  return mesh;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.positions[a];
    sum += (mesh.positions[b] - p).cross(mesh.positions[c] - p).stableNorm() / 2;
  }
  return sum;
}

/// A mass in place of a density is spread over the cloth.
Result<cut::Material> material_of(const Scene& scene, const Mesh& cloth) {
  cut::Material material = scene.material;
  if (!scene.mass) return material;
  material.density = *scene.mass / area(cloth);
  if (material.density > least_magnitude && material.density < most_magnitude) return material;
  return Error{
      fmt::format("{}: a mass of {} on this cloth is a density of {:.3g}: it has to be greater than {} "
                  "and smaller than {}",
                  scene.material_place, *scene.mass, material.density, least_magnitude, most_magnitude)};
}

std::size_t in_use(const auto& entries, auto is_used) {
  return static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), is_used));
}

}  // namespace

SceneRun::SceneRun(Scene scene, Mesh cloth, cut::HybridMesh mesh, cut::Simulation simulation)
    : scene_(std::move(scene)),
      cloth_(std::move(cloth)),
      mesh_(std::move(mesh)),
      simulation_(std::move(simulation)),
      pieces_(cut::pieces(mesh_)),
      colours_(mesh_, pieces_) {
  simulation_.surroundings = scene_.surroundings;
}

Result<SceneRun> SceneRun::start(const Scene& scene, const std::filesystem::path& folder) {
  auto cloth = load(scene.cloth, folder);
  if (!cloth) return cloth.error();
  auto mesh = cut::HybridMesh::build(to_triangle_mesh(*cloth));
  if (!mesh && scene.cloth.file.empty())
    return Error{fmt::format("{}: {}", scene.cloth.place, mesh.error().message)};
  if (!mesh) return explain(mesh.error(), *cloth, (folder / scene.cloth.file).string());
  const auto material = material_of(scene, *cloth);
  if (!material) return material.error();
  auto simulation = cut::Simulation::build(*mesh, *material);
  if (!simulation) return Error{fmt::format("{}: {}", scene.material_place, simulation.error().message)};
  SceneRun run(scene, std::move(*cloth), std::move(*mesh), std::move(*simulation));
  auto anchors = Anchors::hold(scene, run.cloth_, run.mesh_, run.simulation_);
  if (!anchors) return anchors.error();
  run.anchors_ = std::move(*anchors);
  if (const auto checked = run.check_obstacles(); !checked) return checked.error();
  if (const auto loaded = run.load_cutters(folder); !loaded) return loaded.error();
  run.watch_time_step("");
  run.count();
  return run;
}

Result<> SceneRun::load_cutters(const std::filesystem::path& folder) {
  const auto distances = complete(scene_.merge, mesh_);
  if (!distances) return Error{fmt::format("{}: {}", scene_.merge.place, distances.error().message)};
  for (const StaticCutter& cutter : scene_.cutters) {
    const auto mesh = load(cutter.mesh, folder);
    if (!mesh) return mesh.error();
    cutter_meshes_.push_back(to_triangle_mesh(*mesh));
  }
  cutters_.reserve(scene_.cutters.size() + 1);
  for (std::size_t i = 0; i < scene_.cutters.size() + 1; ++i) cutters_.emplace_back(*distances);
  for (std::size_t i = 0; i < scene_.blades.size(); ++i) blades_.emplace_back(*distances);
  return {};
}

/// libcut's own check does not know the place in the scene file.
Result<> SceneRun::check_obstacles() const {
  const double way = longest_way(scene_, mesh_);
  const auto check = [&](const auto& obstacles, const std::vector<std::string>& places) -> Result<> {
    for (std::size_t i = 0; i < obstacles.size(); ++i)
      if (!(obstacles[i].velocity.cwiseAbs().maxCoeff() * scene_.time_step <= way))
        return Error{
            fmt::format("{}: the velocity takes it further in a time step of {} s than longest_way, {:.3g} m",
                        places[i], scene_.time_step, way)};
    return {};
  };
  if (const auto checked = check(scene_.surroundings.half_spaces, scene_.half_space_places); !checked)
    return checked;
  return check(scene_.surroundings.spheres, scene_.sphere_places);
}

Result<> SceneRun::take_over(const cut::Result<cut::Changes>& changes, const std::string& name) {
  if (!changes) return Error{fmt::format("{}: {}", name, changes.error().message)};
  if (changes->empty()) return {};
  if (const auto error = simulation_.apply(*changes, mesh_))
    return Error{fmt::format("{}: {}", name, error->message)};
  colours_.add_copies(*changes);
  return {};
}

Result<> SceneRun::cut_due(double from, double to) {
  for (std::size_t i = 0; i < scene_.cutters.size(); ++i) {
    const StaticCutter& cutter = scene_.cutters[i];
    for (const std::size_t repetition : repetitions_between(cutter, from, to)) {
      const Eigen::Vector3d offset = static_cast<double>(repetition) * cutter.step;
      const auto changes = cutters_[i].cut(mesh_, scenes::moved(cutter_meshes_[i], offset));
      const auto cut = take_over(changes, cutter.mesh.place);
      if (!cut) return cut;
    }
  }
  for (std::size_t i = 0; i < scene_.blades.size(); ++i) {
    const MovingBlade& blade = scene_.blades[i];
    if (!blade_moves_between(blade, from, to)) continue;
    if (!blades_[i].placed())
      if (const auto cut = take_over(blades_[i].cut_to(mesh_, blade_at(blade, from)), blade.place); !cut)
        return cut;
    if (const auto cut = take_over(blades_[i].cut_to(mesh_, blade_at(blade, to)), blade.place); !cut)
      return cut;
  }
  cut::Cutter& tearing = cutters_.back();
  const cut::TriangleMesh tears = cut::tears(mesh_, scene_.tear_limit, tearing.distances());
  if (tears.triangles.empty()) return {};  // a Cutter would look at all of the cloth for nothing
  return take_over(tearing.cut(mesh_, tears), scene_.material_place);
}

Result<> SceneRun::advance() {
  const double frame_time = scene_.frame_time();
  const double from = static_cast<double>(frame_.number) * frame_time;
  const double to = static_cast<double>(frame_.number + 1) * frame_time;
  const auto failed = [&](const std::string& message) {
    return Error{fmt::format("frame {} ({:.4g} s): {}", frame_.number + 1, from, message)};
  };
  const auto start = Clock::now();
  const auto cut = cut_due(from, to);
  frame_.cut_ms = milliseconds_since(start);
  if (mesh_.topology_version != counted_version_) {
    count();
    watch_time_step(fmt::format("after the cuts of frame {} ", frame_.number + 1));
  }
  if (!cut) return failed(cut.error().message);
  const auto moving = Clock::now();
  if (const auto aimed = anchors_.aim(scene_, to, mesh_, simulation_); !aimed)
    return failed(aimed.error().message);
  const auto error = simulation_.step(mesh_, scene_.time_step, scene_.steps_per_frame);
  frame_.simulation_ms = milliseconds_since(moving);
  if (error) return failed(explained(*error));
  const cut::Energy energy = simulation_.energy(mesh_);
  if (!std::isfinite(energy.total())) return failed("the energy is too large to be told");
  ++frame_.number;
  frame_.time = to;
  frame_.energy = energy;
  return {};
}

/// Cuts can make the stable step smaller: in paper mode without a bound.
void SceneRun::watch_time_step(const std::string& when) {
  if (!warning_.empty()) return;
  const double stable = simulation_.stable_time_step(scene_.surroundings.integrator);
  if (scene_.time_step > stable)
    warning_ =
        fmt::format("{}the time step of {} s is more than the {:.3g} s up to which the simulation is stable",
                    when, scene_.time_step, stable);
}

/// What a step that failed means in terms of the scene.
std::string SceneRun::explained(const cut::Error& error) const {
  const std::uint64_t step = simulation_.updates() + 1;
  if (error.kind == cut::Error::Kind::not_converged)
    return fmt::format(
        "the implicit step {} found no velocities that balance its forces; node {} is the furthest off: a "
        "smaller time_step or a lower stiffness makes it easier",
        step, error.element);
  if (error.kind != cut::Error::Kind::unstable) return error.message;
  const std::string where = fmt::format("the simulation blew up in step {} at node {}", step, error.element);
  const double stable = simulation_.stable_time_step(scene_.surroundings.integrator);
  if (!(scene_.time_step > stable))
    return fmt::format(
        "{}: the forces are too large, or it is too fast, for a time step of {} s: it goes "
        "further in one than longest_way, {:.3g} m",
        where, scene_.time_step, longest_way(scene_, mesh_));
  return fmt::format("{}: the time step of {} s is more than the {:.3g} s up to which it is stable", where,
                     scene_.time_step, stable);
}

void SceneRun::count() {
  if (mesh_.topology_version != counted_version_) {
    pieces_ = cut::pieces(mesh_);
    colours_.update(mesh_, pieces_);
    counted_version_ = mesh_.topology_version;
  }
  const cut::Buffers& buffers = mesh_.buffers;
  frame_.pieces = pieces_.list.size();
  frame_.physics_nodes = buffers.nodes.size();
  frame_.physics_edges = simulation_.spring_count();
  frame_.physics_triangles =
      in_use(buffers.triangles, [](const cut::PhysicsTriangle& t) { return t.ancestor.valid(); });
  frame_.render_nodes =
      in_use(buffers.render_vertices, [](const cut::RenderVertex& v) { return v.triangle.valid(); });
  frame_.render_triangles =
      in_use(buffers.render_triangles, [](const cut::RenderTriangle& t) { return t.triangle.valid(); });
  frame_.energy = simulation_.energy(mesh_);
}

}  // namespace snip
