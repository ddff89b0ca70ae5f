/// @file
/// The bounding box ternary tree itself (§5.1): the operations that change one element. In: boxes and values.
/// Out: slots, which name the elements. Queries read the arrays from their own files.
///
/// Beyond the paper, none of which changes the shape of the tree:
/// - each child has a tight box, by which queries prune (tight_boxes.hpp);
/// - volumes that would have a single lower or higher child are left out (Node::compressed), and come back
///   when something falls beside them;
/// - the root's volume doubles when something lies outside.
#pragma once
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "insertion.hpp"
#include "removal.hpp"
#include "tight_boxes.hpp"
#include "tree_storage.hpp"

namespace spatial::detail {

template <class Value, class T, std::size_t D, class Allocator>
class TreeCore : public TreeStorage<Value, T, D, Allocator> {
  using Storage = TreeStorage<Value, T, D, Allocator>;

 public:
  using Storage::Storage;
  using typename Storage::BoxType;
  using typename Storage::LeafType;

  /// Adds an element and returns its slot. @pre is_valid(box)
  std::uint32_t insert(const BoxType& box, Value&& value) {
    const std::uint32_t id = this->take_slot();
    const Slot place = make_room(*this, box, id);
    ::new (static_cast<void*>(this->leaf(place.leaf).values() + place.position)) Value(std::move(value));
    this->release_taken_slot(id);
    this->slot(id).leaf = place.leaf;
    this->slot(id).position = place.position;
    return id;
  }

  /// Adds many elements one by one, as insert_all has them, and returns their slots. If one fails, none
  /// stays.
  template <class Values>
  std::vector<std::uint32_t> insert_each(const std::vector<BuildEntry<T, D>>& entries, Values& values) {
    struct Added {
      TreeCore* tree;
      std::vector<std::uint32_t> slots;
      ~Added() {
        if (tree == nullptr) return;
        for (const std::uint32_t id : slots) tree->erase(id);
      }
    };
    const std::size_t first = this->slot_capacity();
    Added added{this, {}};
    added.slots.reserve(entries.size());
    for (const BuildEntry<T, D>& entry : entries) {
      added.slots.push_back(insert(entry.box, std::move(values[entry.id - first])));
    }
    added.tree = nullptr;
    return std::move(added.slots);
  }

  /// Removes an element and returns its value. @pre the slot is alive
  Value erase(std::uint32_t id) {
    const Slot where = this->place(id);
    Value value(std::move(this->leaf(where.leaf).values()[where.position]));
    remove_at(*this, where);
    this->free_slot(id);
    return value;
  }

  /// Gives an element another box. @pre the slot is alive, is_valid(box)
  void move(std::uint32_t id, const BoxType& box) {
    this->make_slots();
    this->drop_overview();
    const Slot where = this->slot(id);
    LeafType& home = this->leaf(where.leaf);
    const bool same_place =
        home.parent == LeafType::no_parent ||
        (this->node(home.parent).cell.holds(box) && this->node(home.parent).side_of(box) == home.side);
    // A leaf over the soft limit may have become divisible when its tight box grows; making room finds out.
    if (same_place &&
        (home.count <= Storage::leaf_limit || encloses(this->link_box(home.parent, home.side), box))) {
      if (home.is_flat() && !is_point(box)) this->enlarge_leaf(where.leaf, home.capacity, 2 * D);
      if (home.has_old_frame()) home.make_new_frame(this->link_box(home.parent, home.side));
      const BoxType old = home.box(where.position);
      home.set_box(where.position, box);
      const BoxType tight = this->link_box(home.parent, home.side);
      extend_up(*this, home.parent, home.side, box);
      if (!is_inside(tight, old)) shrink_leaf(*this, where.leaf);
      return;
    }
    // First the new place, since only that can fail.
    const Slot place = make_room(*this, box, id);
    const Slot old = this->slot(id);  // making room may have moved it
    ::new (static_cast<void*>(this->leaf(place.leaf).values() + place.position))
        Value(std::move(this->leaf(old.leaf).values()[old.position]));
    this->slot(id).leaf = place.leaf;
    this->slot(id).position = place.position;
    remove_at(*this, old);
  }

  /// The exact bounds of all elements.
  [[nodiscard]] BoxType bounds() const { return exact_bounds(*this); }
};

}  // namespace spatial::detail
