/// @file
/// What a scene file says (docs/scene_file.md), in memory: a cloth, what it is made of, what cuts it, what to
/// write. Lengths are in the units of the cloth; with metres, kilograms and seconds all others follow.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <cut/simulation.hpp>
#include <cut/triangle_mesh.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "snip/merge_distances.hpp"
#include "snip/render/camera.hpp"
#include "snip/result.hpp"

namespace snip {

/// What a scene can ask for at most (docs/scene_file.md, Limits).
inline constexpr std::size_t most_frames = 10'000'000, most_pixels = 4096 * 4096,
                             most_animation_pictures = 20'000, most_animation_pixels = 10'000'000'000;

/// A mesh from a file or a generated one, and how it is put into the scene.
struct MeshSource {
  std::filesystem::path file;  ///< relative to the scene file; empty: `generated`
  cut::TriangleMesh generated;
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  std::string place;  ///< where the scene file says so, for messages
};

/// Where something is at a time: first turned about its axis, then moved.
struct Keyframe {
  double at = 0;
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  double degrees = 0;
};

/// Nodes that are held: those in a box, or those with an index.
struct Anchor {
  std::optional<Eigen::AlignedBox3d> box;
  std::vector<std::uint32_t> nodes;
  Eigen::Vector3d axis{0, 0, 1};
  std::vector<Keyframe> keyframes;  ///< by increasing time, from time 0 and the start on; empty: it stays
  std::string place;
};

/// A mesh that cuts at once: `times` times, `interval` seconds apart, `step` further on each time.
struct StaticCutter {
  MeshSource mesh;
  double at = 0;
  double interval = 0;
  std::size_t times = 1;
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
};

/// A polyline that cuts what it sweeps from its first keyframe to its last.
struct MovingBlade {
  std::vector<Eigen::Vector3d> edge;
  Eigen::Vector3d axis{0, 0, 1};
  std::vector<Keyframe> keyframes;  ///< by increasing time, at least two
  std::string place;
};

/// Distances within which cuts are merged (§4, equation 7); those not given are libcut's default.
struct MergeSettings : GivenMergeDistances {
  std::string place;
};

struct OutputSettings {
  std::size_t width = 800, height = 600;
  std::size_t picture_interval = 10;   ///< frames between pictures; 0: none
  std::size_t animation_interval = 1;  ///< frames between pictures of the animation; 0: none
  bool colour_pieces = true;
  bool show_physics = true;  ///< physics edges and nodes
  bool show_cutters = true;
  bool csv = true;
  std::string mesh = "final.obj";  ///< empty: none
  View view;
  std::optional<Eigen::AlignedBox3d> view_box;  ///< what has to be in the picture
  std::string place;
};

struct Scene {
  std::string description;
  MeshSource cloth;
  cut::Material material;
  std::optional<double> mass;  ///< of the whole cloth; given instead of material.density
  double tear_limit = 0;       ///< length over rest length beyond which springs tear; 0: never
  std::string material_place;
  std::vector<Anchor> anchors;
  cut::Surroundings surroundings;
  /// Where the scene file has the obstacles of `surroundings`, for messages.
  std::vector<std::string> half_space_places, sphere_places;
  double time_step = 0.001;
  std::size_t steps_per_frame = 20;
  std::size_t frames = 100;
  MergeSettings merge;
  std::vector<StaticCutter> cutters;
  std::vector<MovingBlade> blades;
  OutputSettings output;

  /// Seconds from one frame to the next.
  [[nodiscard]] double frame_time() const { return time_step * static_cast<double>(steps_per_frame); }
};

/// What a node, an anchor or an obstacle may go in a time step at most, along x, y or z: what the scene says,
/// or else the diagonal of the uncut cloth's bounding box. O(nodes).
double longest_way(const Scene& scene, const cut::HybridMesh& mesh);

/// Between keyframes all changes evenly; before the first it is there, after the last it stays there.
/// @pre there is a keyframe
Keyframe keyframe_at(const std::vector<Keyframe>& keyframes, double time);

/// Where a keyframe puts a point.
Eigen::Vector3d placed(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, const Keyframe& keyframe);

/// The blade's points at a time; before the first keyframe it waits there, after the last it rests there.
std::vector<Eigen::Vector3d> blade_at(const MovingBlade& blade, double time);

/// True when the blade cuts on the way from one time to the other.
bool blade_moves_between(const MovingBlade& blade, double from, double to);

/// The repetitions (from 0) of the cutter that are due at a frame that lasts from `from` up to, not
/// including, `to`.
std::vector<std::size_t> repetitions_between(const StaticCutter& cutter, double from, double to);

}  // namespace snip
