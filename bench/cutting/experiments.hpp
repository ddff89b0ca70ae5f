/// @file
/// The cloths and cutters that all programs get, and what they must tell afterwards. In: a size. Out: meshes.
///
/// Cells of the sheet are one unit wide and its bumps a tenth of its side high.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "cut/triangle_mesh.hpp"

namespace cutting {

inline constexpr std::size_t step_count = 60;

/// A blade that moves through a sheet from border to border: one swept quad per step. Leaves two pieces.
struct Progressive {
  cut::TriangleMesh cloth;
  std::vector<cut::TriangleMesh> steps;
};

/// Round a corner of the sheet, 12 cells away: each quad meets the same number of triangles in every sheet of
/// 20 × 20 cells or more. The blade stands upright, so that the cut keeps its x and y to the last bit, which
/// helps programs that round; or it leans to one side.
Progressive round_corner_upright(std::size_t cells);
Progressive round_corner_leaning(std::size_t cells);
/// From one side of the sheet to the other, blade leaning: the finer the mesh, the more triangles each quad
/// meets.
Progressive across_sheet(std::size_t cells);

/// A ribbon of 128 triangles across the sheet, cut at once. Leaves two pieces.
struct OneShot {
  cut::TriangleMesh cloth;
  cut::TriangleMesh ribbon;
  std::vector<Eigen::Vector3d> path;  ///< middle of the ribbon, x increasing

  /// The ribbon for programs that cut along the zero set of a function: y less the path's y at the same x.
  [[nodiscard]] double side(double x, double y) const;
};

OneShot wave_across(std::size_t cells);

/// What a progressive cut reports. Written to while the program runs, so that it tells how far one got that
/// crashed on the way.
struct StepsResult {
  std::array<double, step_count> step_ms{};
  std::size_t steps_done = 0;
  std::size_t pieces = 0;
  bool finished = false;
};

struct OneShotResult {
  double prepare_ms = 0;  ///< from the common TriangleMesh to the program's own mesh
  double cut_ms = 0;
  std::size_t pieces = 0;
  std::size_t render_triangles = 0;   ///< what is drawn
  std::size_t physics_triangles = 0;  ///< what is simulated
  double smallest_render_angle = 0;   ///< degrees
  double smallest_physics_angle = 0;
  double peak_mebibytes = 0;
  bool finished = false;
};

/// Result of a program whose mesh is a plain list of triangles that is drawn and simulated as it is.
/// Triangles belong to one piece when a chain of common points joins them.
void describe(const cut::TriangleMesh& mesh, OneShotResult& result);

/// In degrees, of all triangles.
double smallest_angle(const cut::TriangleMesh& mesh);

}  // namespace cutting
