/// @file
/// Strong index types. Each names one flat array of the hybrid mesh; indices of different arrays do not mix.
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace cut {

/// An index into one of the arrays of a mesh. @tparam Tag makes indices of different arrays different types.
/// A default constructed id is invalid.
template <class Tag>
struct Id {
  std::uint32_t value = invalid_value;

  static constexpr std::uint32_t invalid_value = 0xffffffffu;
  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}
  [[nodiscard]] constexpr bool valid() const { return value != invalid_value; }
  [[nodiscard]] constexpr std::size_t index() const { return value; }
  constexpr auto operator<=>(const Id&) const = default;
};

/// A physics node: a mass point of the simulation, or one of the copies that cuts made of it.
using NodeId = Id<struct NodeTag>;
/// A physics triangle: an uncut triangle, or one fragment of a cut one.
using TriangleId = Id<struct TriangleTag>;
/// A triangle, node or edge of the mesh as it was before any cut. They never change.
using AncestorId = Id<struct AncestorTag>;
using AncestorNodeId = Id<struct AncestorNodeTag>;
using AncestorEdgeId = Id<struct AncestorEdgeTag>;

}  // namespace cut

template <class Tag>
struct std::hash<cut::Id<Tag>> {
  std::size_t operator()(cut::Id<Tag> id) const noexcept { return std::hash<std::uint32_t>{}(id.value); }
};
