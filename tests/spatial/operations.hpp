// Runs a sequence of tree operations, encoded in bytes, against a plain list of boxes. Shared by the property
// test and the fuzzer. In: bytes. Out: the first disagreement, or nullptr.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <vector>

#include "bytes.hpp"

namespace operations {

/// Few distinct numbers, so that borders touch and boxes coincide, and now and then one at the end of the
/// type's range.
template <class T>
T coordinate(Bytes& bytes) {
  using Limits = std::numeric_limits<T>;
  const unsigned b = bytes.next();
  if (b < 240) return static_cast<T>(b % 60);
  if constexpr (Limits::has_infinity) {
    const T special[] = {Limits::infinity(),
                         -Limits::infinity(),
                         Limits::max(),
                         Limits::lowest(),
                         Limits::denorm_min(),
                         -Limits::min(),
                         T(-0.0),
                         T(1e-30),
                         T(0.1),
                         T(-1e9)};
    return special[b % 10];
  } else {
    return b % 2 == 0 ? Limits::max() : Limits::lowest();
  }
}

template <class T, std::size_t D>
spatial::Box<T, D> box(Bytes& bytes) {
  spatial::Box<T, D> result;
  const bool flat = bytes.next() % 4 == 0;
  for (std::size_t a = 0; a < D; ++a) {
    result.min[a] = coordinate<T>(bytes);
    result.max[a] = flat ? result.min[a] : coordinate<T>(bytes);
    if (result.max[a] < result.min[a]) std::swap(result.min[a], result.max[a]);
  }
  return result;
}

template <class T, std::size_t D>
class Run {
  struct Element {
    spatial::Box<T, D> box;
    int value;
    spatial::Handle handle;
  };
  using Tree = spatial::BoundingBoxTernaryTree<int, T, D>;

 public:
  std::size_t operations = 0;

  const char* run(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    while (!bytes.empty()) {
      ++operations;
      const char* wrong = step(bytes);
      if (wrong == nullptr) wrong = check();
      if (wrong != nullptr) return wrong;
    }
    return nullptr;
  }

 private:
  const char* step(Bytes& bytes) {
    switch (bytes.next() % 16) {
      default:
        return insert(box<T, D>(bytes));
      case 7:
        return reload();
      case 8:
        return erase(bytes.next());
      case 9:
        return move(bytes.next(), box<T, D>(bytes));
      case 10:
        return bulk(bytes);
      case 11:
        return query(box<T, D>(bytes));
      case 12:
        return nearest(box<T, D>(bytes), bytes.next() % 20);
      case 13:
        return erase_where(box<T, D>(bytes));
      case 14:
        return copy_and_move(bytes.next());
      case 15: {
        // Many of the same, to fill a leaf over its limit.
        const auto same = box<T, D>(bytes);
        for (unsigned n = bytes.next() % 24; n > 0; --n) {
          if (const char* wrong = insert(same)) return wrong;
        }
        return nullptr;
      }
    }
  }

  const char* insert(const spatial::Box<T, D>& b) {
    const auto handle = tree_.insert(b, next_value_);
    if (!handle.valid()) return "a valid box is accepted";
    elements_.push_back({b, next_value_++, handle});
    return nullptr;
  }
  const char* erase(unsigned which) {
    if (elements_.empty()) return nullptr;
    Element& element = elements_[which % elements_.size()];
    if (!tree_.erase(element.handle)) return "an element can be erased";
    if (tree_.contains(element.handle) || tree_.erase(element.handle)) return "a stale handle is known";
    element = elements_.back();
    elements_.pop_back();
    return nullptr;
  }
  const char* move(unsigned which, const spatial::Box<T, D>& b) {
    if (elements_.empty()) return nullptr;
    Element& element = elements_[which % elements_.size()];
    element.box = b;
    return tree_.move(element.handle, b) ? nullptr : "an element can be moved";
  }
  const char* bulk(Bytes& bytes) {
    std::vector<std::pair<spatial::Box<T, D>, int>> many;
    for (unsigned n = bytes.next() % 64; n > 0; --n) many.push_back({box<T, D>(bytes), next_value_++});
    if (many.size() > 3) many[2].first.min[0] = T(2), many[2].first.max[0] = T(1);  // is to be refused
    std::vector<spatial::Handle> handles;
    const std::size_t added = tree_.insert(many.begin(), many.end(), std::back_inserter(handles));
    if (handles.size() != many.size()) return "a handle for each";
    std::size_t valid = 0;
    for (std::size_t i = 0; i < many.size(); ++i) {
      if (!handles[i].valid()) continue;
      ++valid;
      elements_.push_back({many[i].first, many[i].second, handles[i]});
    }
    return valid == added && added + (many.size() > 3 ? 1 : 0) == many.size() ? nullptr
                                                                              : "bulk insert counts";
  }
  /// All elements are loaded into an empty tree, without asking for handles: so it has no slots.
  const char* reload() {
    std::vector<std::pair<spatial::Box<T, D>, int>> many;
    for (const Element& e : elements_) many.push_back({e.box, e.value});
    tree_.clear();
    if (tree_.insert(many.begin(), many.end()) != many.size()) return "loading counts";
    std::map<int, spatial::Handle> handles;
    for (auto i = tree_.begin(); i != tree_.end(); ++i) handles[*i] = i.handle();
    for (Element& e : elements_) {
      if (tree_.contains(e.handle)) return "clear makes stale";
      e.handle = handles[e.value];
    }
    return nullptr;
  }
  const char* query(const spatial::Box<T, D>& q) {
    using Box = spatial::Box<T, D>;
    const auto inside = [](const Box& e, const Box& o) { return spatial::encloses(o, e); };
    if (!agree(spatial::intersects(q), [&](const Box& e) { return spatial::touch(e, q); }))
      return "intersects";
    if (!agree(spatial::disjoint(q), [&](const Box& e) { return !spatial::touch(e, q); })) return "disjoint";
    if (!agree(spatial::covered_by(q), [&](const Box& e) { return inside(e, q); })) return "covered_by";
    if (!agree(spatial::covers(q), [&](const Box& e) { return inside(q, e); })) return "covers";
    if (!agree(spatial::within(q), [&](const Box& e) { return strictly(e, q); })) return "within";
    if (!agree(spatial::contains(q), [&](const Box& e) { return strictly(q, e); })) return "contains";
    if (!agree(spatial::overlaps(q),
               [&](const Box& e) { return interiors_meet(e, q) && !inside(e, q) && !inside(q, e); }))
      return "overlaps";
    return pairs();
  }
  template <class P, class Expected>
  bool agree(const P& predicate, Expected expected_of) {
    std::vector<int> expected;
    for (const Element& e : elements_) {
      if (expected_of(e.box)) expected.push_back(e.value);
    }
    std::vector<int> found;
    tree_.query(predicate, std::back_inserter(found));
    std::vector<int> lazily;
    for (const int value : tree_.query(predicate)) lazily.push_back(value);
    for (auto* values : {&expected, &found, &lazily}) std::sort(values->begin(), values->end());
    return found == expected && lazily == expected;
  }
  static bool strictly(const spatial::Box<T, D>& e, const spatial::Box<T, D>& q) {
    bool result = spatial::encloses(q, e);
    for (std::size_t a = 0; a < D; ++a) {
      result &= e.min[a] < e.max[a] || (q.min[a] < e.min[a] && e.max[a] < q.max[a]);
    }
    return result;
  }
  static bool interiors_meet(const spatial::Box<T, D>& e, const spatial::Box<T, D>& q) {
    bool result = true;
    for (std::size_t a = 0; a < D; ++a) result &= q.min[a] < e.max[a] && e.min[a] < q.max[a];
    return result;
  }
  const char* pairs() {
    if (elements_.size() > 64) return nullptr;  // a matter of time
    std::vector<std::pair<int, int>> expected, found;
    for (const Element& a : elements_) {
      for (const Element& b : elements_) {
        if (a.value < b.value && spatial::touch(a.box, b.box)) expected.push_back({a.value, b.value});
      }
    }
    tree_.pairs([&](int a, int b) { found.push_back({std::min(a, b), std::max(a, b)}); });
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    return found == expected ? nullptr : "pairs";
  }
  /// The path from one corner of a box to the other, and on.
  const char* along_path(const spatial::Box<T, D>& q) {
    using Metric = spatial::detail::PathMetric<T, D>;
    using S = typename Metric::S;
    spatial::Point<S, D> origin, direction;
    for (std::size_t a = 0; a < D; ++a) {
      origin[a] = static_cast<S>(q.min[a]);
      direction[a] = static_cast<S>(q.max[a]) - origin[a];
    }
    const Metric metric(origin, direction, std::numeric_limits<S>::infinity());
    std::vector<S> expected;
    for (const Element& e : elements_) {
      const S t = metric.key(e.box);
      if (t == t) expected.push_back(t);
    }
    std::sort(expected.begin(), expected.end());
    std::vector<S> found;
    tree_.query(spatial::ray_hits(origin, direction),
                [&](const int&, spatial::Handle, S t) { found.push_back(t); });
    return found == expected ? nullptr : "hits of a ray, in order";
  }
  const char* nearest(const spatial::Box<T, D>& q, std::size_t k) {
    using Metric = spatial::detail::BoxMetric<T, D>;
    const auto key = [&](const spatial::Box<T, D>& b) {
      T rows[2 * D + 16] = {};
      for (std::size_t a = 0; a < D; ++a) rows[a] = b.min[a], rows[D + a] = b.max[a];
      typename Metric::S result[spatial::detail::keys_room];
      Metric(q).keys({rows, 1, D}, 1, result);
      return Metric::distance(result[0]);
    };
    std::vector<typename Metric::S> expected;
    for (const Element& e : elements_) expected.push_back(key(e.box));
    std::sort(expected.begin(), expected.end());
    expected.resize(std::min(k, expected.size()));
    std::vector<typename Metric::S> found;
    tree_.query(spatial::nearest(q, k), [&](const int&, spatial::Handle h, auto d) {
      if (d == key(tree_.box(h))) found.push_back(d);
    });
    if (found != expected) return "nearest";
    found.clear();
    auto range = tree_.query(spatial::nearest(q, k));
    for (auto i = range.begin(); i != range.end(); ++i) found.push_back(i.distance());
    if (found != expected) return "nearest as a range";
    return along_path(q);
  }
  const char* erase_where(const spatial::Box<T, D>& q) {
    const std::size_t erased =
        tree_.erase_if(spatial::covered_by(q) && spatial::satisfies([](int v) { return v % 2 == 0; }));
    const std::size_t before = elements_.size();
    std::erase_if(elements_,
                  [&](const Element& e) { return spatial::encloses(q, e.box) && e.value % 2 == 0; });
    return before - elements_.size() == erased ? nullptr : "erase_if";
  }
  const char* copy_and_move(unsigned how) {
    switch (how % 4) {
      case 0: {
        Tree copy(tree_);
        tree_.clear();
        if (tree_.contains(elements_.empty() ? spatial::Handle{} : elements_[0].handle))
          return "clear makes stale";
        tree_.swap(copy);
        return nullptr;
      }
      case 1: {
        Tree moved(std::move(tree_));
        tree_ = moved;
        return nullptr;
      }
      case 2: {
        Tree moved;
        moved = std::move(tree_);
        tree_ = std::move(moved);
        return nullptr;
      }
      default:
        if (how < 224) return nullptr;
        tree_.clear();
        elements_.clear();
        return nullptr;
    }
  }
  const char* check() {
    const auto complaints = tree_.validate();
    if (!complaints.empty()) return complaints.front();
    if (tree_.size() != elements_.size()) return "size";
    auto bounds = spatial::empty_box<T, D>();
    for (const Element& e : elements_) spatial::extend(bounds, e.box);
    if (!(tree_.bounds() == bounds)) return "bounds";
    for (const Element& e : elements_) {
      if (!tree_.contains(e.handle)) return "a handle stays valid";
      if (tree_.value(e.handle) != e.value || !(tree_.box(e.handle) == e.box))
        return "a handle names its element";
    }
    return nullptr;
  }

  Tree tree_;
  std::vector<Element> elements_;
  int next_value_ = 0;
};

}  // namespace operations
