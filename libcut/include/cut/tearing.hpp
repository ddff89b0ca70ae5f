/// @file
/// Tearing: cloth that is stretched beyond a limit is cut across the strain, through the same pipeline as any
/// other cut. In: a hybrid mesh where it is now. Out: a mesh to cut it with.
#pragma once
#include "cut/hybrid_mesh.hpp"
#include "cut/merge_distances.hpp"
#include "cut/triangle_mesh.hpp"

namespace cut {

/// A cutter for one step of a tear; without triangles where nothing is torn. Give it to a Cutter that is used
/// for tears only, then let the cloth move, and ask again: a tear goes on by one triangle each time.
///
/// A fragment is torn when it renders both ends of a spring that is longer than `limit` times its rest
/// length, from side to side of its polygon, across the direction in which its physics triangle is stretched
/// most. The tear begins at the end of an earlier cut or tear on the fragment's sides. Where there is none,
/// it begins in the middle of the spring, if no other spring at its two nodes is stretched more. A torn
/// fragment renders one end of the spring only and so is not torn for it again: tearing ends, whatever holds
/// the cloth.
///
/// @param limit length over rest length, > 1; with another value, NaN included, nothing is torn
/// @param distances those of the Cutter
/// Complexity: O(springs), and O(nodes of its polygon) for each fragment with an overstretched spring.
[[nodiscard]] TriangleMesh tears(const HybridMesh& mesh, double limit, const MergeDistances& distances);

}  // namespace cut
