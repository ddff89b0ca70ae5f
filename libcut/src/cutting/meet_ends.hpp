/// @file
/// Step 2 for ends of the same cut (§4.2, §7): an end goes where another end goes that was detected within δn
/// of it, wherever a node, an edge or a border lies between them. In: line ends after merge_cut_endpoints.
/// Out: some of them go elsewhere.
#pragma once
#include <vector>

#include "cutting/state.hpp"

namespace cut {

/// Ends at nodes stay where they are, then those on edges follow, then free ones; among equals the first
/// stays. A tip, at which no other line of the cut ends, goes to the target of another tip, if that lies
/// within δc. Free ends of different triangles meet at one of them; those of one triangle are left to
/// merge_free_endpoints. Runs over the works one after the other. @pre works are sorted by ancestor
void meet_ends(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context);

}  // namespace cut
