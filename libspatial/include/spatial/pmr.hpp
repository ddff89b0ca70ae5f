/// @file
/// The tree with a polymorphic allocator. In: a memory resource. Out: a tree that takes all memory from it.
#pragma once
#include <cstddef>
#include <memory_resource>

#include "bounding_box_ternary_tree.hpp"

namespace spatial::pmr {

template <class Value, class T, std::size_t D, class BoxOf = DefaultBoxOf<T, D>, class Equal = DefaultEqual>
using BoundingBoxTernaryTree =
    spatial::BoundingBoxTernaryTree<Value, T, D, BoxOf, Equal, std::pmr::polymorphic_allocator<Value>>;

}  // namespace spatial::pmr
