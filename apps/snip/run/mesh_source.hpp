/// @file
/// The meshes of a scene file: `{"file": ...}` or `{"shape": ...}` with the numbers that the shape wants, and
/// where it is put. docs/scene_file.md lists the shapes.
#pragma once
#include "snip/run/json_reader.hpp"
#include "snip/run/scene.hpp"

namespace snip {

/// A generated mesh: its name and the keys it has besides those that place it.
struct MeshShape {
  std::string_view name;
  std::vector<std::string_view> keys;
  cut::TriangleMesh (*read)(const JsonValue&);
};

const std::vector<MeshShape>& mesh_shapes();

/// Throws JsonError.
MeshSource read_mesh_source(const JsonValue& value);

}  // namespace snip
