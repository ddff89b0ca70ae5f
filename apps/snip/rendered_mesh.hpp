/// @file
/// From the hybrid mesh back to a mesh for a file: the render triangles as they are now, with the attributes
/// of the mesh that was cut. In: the input mesh and the hybrid mesh built from it. Out: a Mesh.
#pragma once
#include "cut/hybrid_mesh.hpp"
#include "snip/mesh_file/mesh.hpp"

namespace snip {

/// The render mesh. A vertex that no cut made keeps the bits of its position and the attributes of its
/// corners; on a cut, attributes are interpolated linearly over the input triangle, normals scaled to unit
/// length again. `polygon_of_triangle` names the input's polygons.
/// @pre `hybrid` was built from to_triangle_mesh(input)
Mesh rendered_mesh(const Mesh& input, const cut::HybridMesh& hybrid);

}  // namespace snip
