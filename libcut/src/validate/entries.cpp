/// @file
/// Rules on single entries of the flat arrays: one_owner_each, fragments_match, free_lists_consistent,
/// stamps_in_range, vertices_in_triangles. In: the mesh. Out: violations.
#include "validate/rules.hpp"

namespace cut::validation {
namespace {

void check_owners(const std::vector<std::uint32_t>& table, std::size_t count, const char* kind,
                  Report& report) {
  std::vector<std::uint32_t> owners(count, 0);
  for (const std::uint32_t i : table)
    if (i != HybridMesh::none) ++owners[i];
  for (std::size_t i = 0; i < count; ++i)
    if (owners[i] != 1)
      report.add("one_owner_each", name(kind, i) + " has " + std::to_string(owners[i]) + " owners");
}

/// Every live physics triangle is exactly one fragment of its ancestor and has copies of its nodes.
void check_fragments(const HybridMesh& mesh, Report& report) {
  constexpr const char* rule = "fragments_match";
  const auto& triangles = mesh.buffers.triangles;
  std::vector<std::uint32_t> uses(triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const AncestorId ancestor{t};
    if (mesh.fragment_count(ancestor) == 0) report.add(rule, name("ancestor", t) + " has no fragment");
    for (std::size_t f = 0; f < mesh.fragment_count(ancestor); ++f) {
      const TriangleId id = mesh.fragment(ancestor, f);
      if (id.index() >= triangles.size() || triangles[id.index()].ancestor != ancestor) {
        report.add(rule,
                   name("triangle", id.index()) + " is not a fragment of ancestor " + std::to_string(t));
        continue;
      }
      ++uses[id.index()];
      for (std::size_t i = 0; i < 3; ++i) {
        const NodeId node = triangles[id.index()].nodes[i];
        if (mesh.buffers.nodes[node.index()] != mesh.ancestors.triangles[t].nodes[i])
          report.add(rule, name("node", node.index()) + " of triangle " + std::to_string(id.index()) +
                               " is no copy of the ancestor's corner " + std::to_string(i));
      }
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (uses[t] != (triangles[t].ancestor.valid() ? 1u : 0u))
      report.add(rule, name("triangle", t) + " stands for " + std::to_string(uses[t]) + " fragments");
}

template <class Id, class Entry>
void check_free_list(const std::vector<Id>& list, const std::vector<Entry>& entries, const char* kind,
                     Report& report) {
  std::vector<std::uint32_t> listed(entries.size(), 0);
  for (const Id id : list) ++listed[id.index()];
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (listed[i] != (entries[i].triangle.valid() ? 0u : 1u))
      report.add("free_lists_consistent", name(kind, i) +
                                              (entries[i].triangle.valid() ? " is in use" : " is free") +
                                              " and listed as free " + std::to_string(listed[i]) + " times");
}

void check_stamps(const HybridMesh& mesh, Report& report) {
  constexpr const char* rule = "stamps_in_range";
  const auto late = [&](const char* kind, std::size_t i) {
    report.add(rule, name(kind, i) + " was part of a cut that has not happened yet");
  };
  for (std::size_t n = 0; n < mesh.node_stamps.size(); ++n)
    if (mesh.node_stamps[n] > mesh.cut_count) late("ancestor node", n);
  for (std::size_t s = 0; s < mesh.edge_states.size(); ++s)
    for (const BoundaryNode& node : mesh.edge_states[s].nodes)
      if (node.stamp > mesh.cut_count) late("a boundary node of edge state", s);
  for (std::size_t i = 0; i < mesh.arrangements.size(); ++i)
    for (const ArrangementNode& node : mesh.arrangements[i].nodes)
      if (node.stamp > mesh.cut_count) late("a node of arrangement", i);
}

/// The point of a render vertex lies in its physics triangle, whose nodes it repeats.
void check_vertices(const HybridMesh& mesh, Report& report) {
  constexpr const char* rule = "vertices_in_triangles";
  const Buffers& b = mesh.buffers;
  for (std::size_t v = 0; v < b.render_vertices.size(); ++v) {
    const RenderVertex& vertex = b.render_vertices[v];
    if (!vertex.triangle.valid()) continue;
    // Each coordinate by itself first: the sum of broken ones may overflow.
    const auto in_range = [](std::int32_t c) { return c >= 0 && c <= lattice_size; };
    if (!in_range(vertex.point.x) || !in_range(vertex.point.y) || !vertex.point.inside())
      report.add(rule, name("render vertex", v) + " lies outside of its triangle");
    const PhysicsTriangle& triangle = b.triangles[vertex.triangle.index()];
    if (!triangle.ancestor.valid())
      report.add(rule, name("render vertex", v) + " lies in a removed triangle");
    else if (triangle.nodes != vertex.nodes)
      report.add(rule, name("render vertex", v) + " does not hang on the nodes of its triangle");
  }
}

}  // namespace

void check_entries(const HybridMesh& mesh, Report& report) {
  check_owners(mesh.arrangement_of, mesh.arrangements.size(), "arrangement", report);
  check_owners(mesh.edge_state_of, mesh.edge_states.size(), "edge state", report);
  check_fragments(mesh, report);
  check_free_list(mesh.free_render_vertices, mesh.buffers.render_vertices, "render vertex", report);
  check_free_list(mesh.free_render_triangles, mesh.buffers.render_triangles, "render triangle", report);
  check_stamps(mesh, report);
  check_vertices(mesh, report);
}

}  // namespace cut::validation
