/// @file
/// The programs that are compared. A peer that was not found when the build was configured is left out.
#pragma once
#include "cutting/experiments.hpp"

namespace cutting {

/// libcut: `Cutter::cut` with its render buffers and change set. The tree of the broad phase
/// is built in the second step; a one-shot cut counts `HybridMesh::build`.
void libcut_steps(const Progressive& experiment, StepsResult& result);
void libcut_once(const OneShot& experiment, OneShotResult& result);

#ifdef SNIP_BENCH_CGAL
/// CGAL `Polygon_mesh_processing::split`, with inexact (EPICK) and exact (EPECK) constructions.
void epick_steps(const Progressive& experiment, StepsResult& result);
void epeck_steps(const Progressive& experiment, StepsResult& result);
void epick_once(const OneShot& experiment, OneShotResult& result);
void epeck_once(const OneShot& experiment, OneShotResult& result);
#endif

#ifdef SNIP_BENCH_BULLET
/// Bullet `btSoftBody::refine` along `OneShot::side`, in single precision. Takes memory by the square of
/// the number of nodes.
void bullet_once(const OneShot& experiment, OneShotResult& result);
#endif

#ifdef SNIP_BENCH_VTK
/// VTK `vtkClipPolyData` along `OneShot::side`, both halves kept.
void vtk_once(const OneShot& experiment, OneShotResult& result);
#endif

}  // namespace cutting
