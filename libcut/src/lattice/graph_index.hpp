/// @file
/// Finds nodes and edges of a large planar graph by where they are (§5: for triangles
/// with "large node and edge numbers").
/// In: nodes and edges, added and removed one by one. Out: those near a segment. Small graphs are searched
/// one by one without it.
#pragma once
#include <cstdint>
#include <optional>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <unordered_map>
#include <vector>

#include "cut/lattice_point.hpp"

namespace cut::lattice {

class GraphIndex {
 public:
  void add_node(std::uint32_t node, LatticePoint p);
  [[nodiscard]] std::optional<std::uint32_t> node_at(LatticePoint p) const;

  /// @pre edges are added once, numbered upwards
  void add_edge(std::uint32_t edge, std::uint32_t from, std::uint32_t to, LatticePoint a, LatticePoint b);
  void remove_edge(std::uint32_t edge, std::uint32_t from, std::uint32_t to);
  /// The edge between two nodes, in either direction.
  [[nodiscard]] std::optional<std::uint32_t> edge_between(std::uint32_t from, std::uint32_t to) const;

  /// Calls visit(node) for all nodes within a lattice unit of the segment, and perhaps for others.
  template <class Visit>
  void nodes_near(LatticePoint a, LatticePoint b, const Visit& visit) const {
    nodes_.query(spatial::box_satisfies(NearSegment(a, b)), visit);
  }
  /// Calls visit(edge) for all edges whose boxes come within a lattice unit of the segment, and perhaps for
  /// others.
  template <class Visit>
  void edges_near(LatticePoint a, LatticePoint b, const Visit& visit) const {
    edges_.query(spatial::box_satisfies(NearSegment(a, b)), visit);
  }

 private:
  using Box = spatial::Box<std::int32_t, 2>;
  using Tree = spatial::BoundingBoxTernaryTree<std::uint32_t, std::int32_t, 2>;

  /// Whether a box that is a unit wider on each side meets a segment. Exact.
  class NearSegment {
   public:
    NearSegment(LatticePoint a, LatticePoint b);
    bool operator()(const Box& box) const;

   private:
    LatticePoint a_;
    Box bounds_;
    std::int64_t dx_, dy_;
  };

  Tree nodes_;
  Tree edges_;
  std::vector<spatial::Handle> handles_;  ///< per edge
  std::unordered_map<std::uint64_t, std::uint32_t> node_at_;
  std::unordered_map<std::uint64_t, std::uint32_t> edge_between_;
};

}  // namespace cut::lattice
