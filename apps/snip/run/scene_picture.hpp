/// @file
/// What a frame of a scene looks like: the shaded render mesh, the physics mesh over it, the cuts, the
/// cutters, the obstacles.
#pragma once
#include "snip/render/camera.hpp"
#include "snip/render/drawing.hpp"
#include "snip/run/scene_run.hpp"

namespace snip {

/// The camera of the scene. Without a box of its own it shows the cloth as it was at the start, and room
/// below it.
Camera scene_camera(const SceneRun& run);

/// @param pixels_per_edge how long an edge of the cloth is in the picture: lines and dots of a fine cloth are
/// thin
Drawing scene_drawing(const SceneRun& run, double pixels_per_edge);

/// How long the mean edge of the uncut cloth is in a picture by this camera, about, in pixels.
double pixels_per_edge(const SceneRun& run, const Camera& camera);

}  // namespace snip
