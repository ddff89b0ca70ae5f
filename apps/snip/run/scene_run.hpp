/// @file
/// A scene in motion: in each frame the cutters that are due cut, the simulation follows, the cloth moves.
/// Writes nothing; reads the mesh files that the scene names.
#pragma once
#include <cstddef>
#include <cut/blade.hpp>
#include <cut/cutter.hpp>
#include <cut/hybrid_mesh.hpp>
#include <cut/pieces.hpp>
#include <cut/simulation.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "snip/mesh_file/mesh.hpp"
#include "snip/run/anchors.hpp"
#include "snip/run/piece_colours.hpp"
#include "snip/run/scene.hpp"

namespace snip {

/// Measured at the end of a frame; frame 0 is the start.
struct Frame {
  std::size_t number = 0;
  double time = 0;
  std::size_t pieces = 0;
  std::size_t physics_nodes = 0, physics_edges = 0, physics_triangles = 0;
  std::size_t render_nodes = 0, render_triangles = 0;
  cut::Energy energy;
  double cut_ms = 0, simulation_ms = 0;  ///< what the frame took
};

class SceneRun {
 public:
  /// @param folder where the scene file is
  static Result<SceneRun> start(const Scene& scene, const std::filesystem::path& folder);

  /// Goes on by a frame. After an error the cloth is as it was before the step that failed.
  Result<> advance();

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Mesh& cloth() const { return cloth_; }  ///< as it was before the first frame
  [[nodiscard]] const cut::HybridMesh& mesh() const { return mesh_; }
  [[nodiscard]] const cut::Simulation& simulation() const { return simulation_; }
  [[nodiscard]] const cut::Pieces& pieces() const { return pieces_; }
  [[nodiscard]] const PieceColours& colours() const { return colours_; }
  /// The static cutters' meshes, where they cut first.
  [[nodiscard]] const std::vector<cut::TriangleMesh>& cutter_meshes() const { return cutter_meshes_; }
  /// That the time step exceeds the one estimated to be stable, as soon as it does: at the start, or after a
  /// cut. Or empty.
  [[nodiscard]] const std::string& warning() const { return warning_; }

 private:
  SceneRun(Scene scene, Mesh cloth, cut::HybridMesh mesh, cut::Simulation simulation);
  Result<> load_cutters(const std::filesystem::path& folder);
  [[nodiscard]] Result<> check_obstacles() const;
  Result<> take_over(const cut::Result<cut::Changes>& changes, const std::string& name);
  Result<> cut_due(double from, double to);
  void watch_time_step(const std::string& when);
  [[nodiscard]] std::string explained(const cut::Error& error) const;
  void count();

  Scene scene_;
  Mesh cloth_;
  cut::HybridMesh mesh_;
  cut::Simulation simulation_;
  Anchors anchors_;
  std::vector<cut::TriangleMesh> cutter_meshes_;
  std::vector<cut::Cutter> cutters_;  // those of cutter_meshes_, then one for tears
  std::vector<cut::Blade> blades_;
  cut::Pieces pieces_;
  PieceColours colours_;
  std::string warning_;
  std::uint64_t counted_version_ = 0;
  Frame frame_;
};

}  // namespace snip
