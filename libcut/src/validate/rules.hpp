/// @file
/// The rules of docs/data_model.md in groups, one file each. In: the mesh. Out: violations in the report.
/// `ids_in_range` comes first; the others require that it found nothing, and then cope with any other fault.
#pragma once
#include "cut/hybrid_mesh.hpp"
#include "validate/report.hpp"

namespace cut::validation {

/// Rule ids_in_range: array sizes fit each other and no index points outside of its array. O(n).
void check_ids(const HybridMesh& mesh, Report& report);

/// Rule ancestors_consistent: the uncut mesh agrees with itself. O(n).
void check_ancestors(const HybridMesh& mesh, Report& report);

/// Rules one_owner_each, fragments_match, free_lists_consistent, stamps_in_range, vertices_in_triangles.
/// O(n).
void check_entries(const HybridMesh& mesh, Report& report);

/// Rules boundary_nodes_agree and (for the flags) edge_sides_agree: both sides of an ancestor edge carry the
/// nodes of its state. O(n).
void check_boundaries(const HybridMesh& mesh, Report& report);

/// Rules nodes_in_place, arrangement_planar, edge_sides_agree, polygon_simple, polygons_partition_ancestor:
/// each arrangement by itself. O(n log n).
void check_arrangements(const HybridMesh& mesh, Report& report);

/// Rule render_triangles_cover_polygons. O(n log n).
void check_triangulations(const HybridMesh& mesh, Report& report);

/// Rules physics_nodes_are_components, render_vertices_are_components, components_agree. O(n α(n)).
void check_connectivity(const HybridMesh& mesh, Report& report);

/// Rules springs_match and springs_keep_rest_length. O(n log n).
void check_springs(const HybridMesh& mesh, Report& report);

}  // namespace cut::validation
