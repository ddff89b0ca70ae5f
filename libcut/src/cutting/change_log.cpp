#include "cutting/change_log.hpp"

#include <utility>

#include "cutting/in_parts.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

template <class T>
ArrayChanges<T> entries(std::vector<std::uint32_t>& indices, const std::vector<T>& array) {
  lattice::sort_unique(indices);
  ArrayChanges<T> changes;
  changes.size_after = array.size();
  changes.entries.reserve(indices.size());
  for (const std::uint32_t i : indices) changes.entries.push_back({i, array[i]});
  return changes;
}

template <class T>
void apply_to(std::vector<T>& array, const ArrayChanges<T>& changes) {
  array.resize(changes.size_after);
  for (const auto& entry : changes.entries) array[entry.index] = entry.value;
}

template <class T>
ArrayChanges<T> inverse_of(const ArrayChanges<T>& changes, const std::vector<T>& before) {
  ArrayChanges<T> back;
  back.size_after = before.size();
  for (const auto& entry : changes.entries)
    if (entry.index < before.size()) back.entries.push_back({entry.index, before[entry.index]});
  return back;
}

}  // namespace

Changes publish(const HybridMesh& mesh, ChangeLog&& log, const Executor& executor) {
  Changes changes;
  changes.node_copies = std::move(log.node_copies);
  changes.triangle_copies = std::move(log.triangle_copies);
  changes.spring_copies = std::move(log.spring_copies);
  executor.for_each(5, [&](std::size_t which) {
    if (which == 0) changes.render_triangles = entries(log.render_triangles, mesh.buffers.render_triangles);
    if (which == 1) changes.render_vertices = entries(log.render_vertices, mesh.buffers.render_vertices);
    if (which == 2) changes.springs = entries(log.springs, mesh.buffers.springs);
    if (which == 3) changes.triangles = entries(log.triangles, mesh.buffers.triangles);
    if (which == 4) changes.nodes = entries(log.nodes, mesh.buffers.nodes);
  });
  for (const auto& entry : changes.triangles.entries) {
    if (!entry.value.ancestor.valid()) continue;
    append(log.edges, mesh.ancestors.triangles[entry.value.ancestor.index()].edges);
  }
  lattice::sort_unique(log.edges);
  changes.edges = std::move(log.edges);
  return changes;
}

void apply(const Changes& changes, Buffers& buffers) {
  if (changes.empty()) return;
  apply_to(buffers.nodes, changes.nodes);
  apply_to(buffers.triangles, changes.triangles);
  apply_to(buffers.springs, changes.springs);
  apply_to(buffers.render_vertices, changes.render_vertices);
  apply_to(buffers.render_triangles, changes.render_triangles);
}

Changes inverse(const Changes& changes, const Buffers& before) {
  Changes back;
  back.version_before = changes.version_after;
  back.version_after = changes.version_before;
  if (changes.empty()) return back;
  back.nodes = inverse_of(changes.nodes, before.nodes);
  back.triangles = inverse_of(changes.triangles, before.triangles);
  back.springs = inverse_of(changes.springs, before.springs);
  back.render_vertices = inverse_of(changes.render_vertices, before.render_vertices);
  back.render_triangles = inverse_of(changes.render_triangles, before.render_triangles);
  return back;
}

}  // namespace cut
