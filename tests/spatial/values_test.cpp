// Values of any kind: move-only, with a throwing copy, with an allocator; and the tree as a value itself.
#include <doctest/doctest.h>

#include <memory>
#include <memory_resource>
#include <random>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <spatial/pmr.hpp>
#include <stdexcept>
#include <string>

namespace {

using Box = spatial::Box<float, 2>;

Box box_at(int i) {
  const float x = float(i * 7919LL % 1000);
  const float y = float(i * 104729LL % 997);
  return {{x, y}, {x + 1, y + 1}};
}

/// Copying throws when the countdown ends; so does moving, which is a copy.
struct Fragile {
  inline static int countdown = -1;
  inline static int alive = 0;
  int number;
  explicit Fragile(int n) : number(n) { ++alive; }
  Fragile(const Fragile& other) : number(other.number) {
    if (countdown >= 0 && countdown-- == 0) throw std::runtime_error("copy");
    ++alive;
  }
  Fragile& operator=(const Fragile&) = default;
  ~Fragile() { --alive; }
  bool operator==(const Fragile&) const = default;
};

/// A memory resource that fails after a number of allocations.
class Failing : public std::pmr::memory_resource {
 public:
  int countdown = -1;
  std::size_t in_use = 0;

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (countdown >= 0 && countdown-- == 0) throw std::bad_alloc();
    in_use += bytes;
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* p, std::size_t bytes, std::size_t alignment) override {
    in_use -= bytes;
    std::pmr::new_delete_resource()->deallocate(p, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace

TEST_CASE("move-only values") {
  spatial::BoundingBoxTernaryTree<std::unique_ptr<int>, float, 2> tree;
  std::vector<spatial::Handle> handles;
  for (int i = 0; i < 500; ++i) handles.push_back(tree.insert(box_at(i), std::make_unique<int>(i)));
  auto moved = std::move(tree);
  CHECK(tree.empty());
  CHECK(*moved.value(handles[77]) == 77);
  std::unique_ptr<int> out = moved.extract(handles[77]);
  CHECK(*out == 77);
  CHECK_FALSE(moved.contains(handles[77]));
  static_assert(!std::is_copy_constructible_v<decltype(tree)>);
  static_assert(std::is_nothrow_move_constructible_v<decltype(tree)>);
}

TEST_CASE("values that are boxes, or hold one") {
  using Pair = std::pair<Box, std::string>;
  spatial::BoundingBoxTernaryTree<Pair, float, 2> pairs;
  spatial::BoundingBoxTernaryTree<Box, float, 2> boxes;
  struct Thing {
    int i;
    bool operator==(const Thing&) const = default;
  };
  struct BoxOfThing {
    Box operator()(const Thing& t) const { return box_at(t.i); }
  };
  spatial::BoundingBoxTernaryTree<Thing, float, 2, BoxOfThing> things;
  for (int i = 0; i < 300; ++i) {
    pairs.insert(Pair{box_at(i), std::to_string(i)});
    boxes.insert(box_at(i));
    boxes.insert(box_at(i));
    things.insert(Thing{i});
  }
  CHECK(pairs.contains(Pair{box_at(9), "9"}));
  CHECK_FALSE(pairs.contains(Pair{box_at(9), "8"}));
  CHECK(pairs.erase(Pair{box_at(9), "9"}) == 1);
  CHECK(pairs.erase(Pair{box_at(9), "9"}) == 0);
  CHECK(boxes.count(box_at(5)) == 2);
  CHECK(boxes.erase(box_at(5)) == 1);
  CHECK(boxes.count(box_at(5)) == 1);
  CHECK(things.value(things.find(Thing{123})).i == 123);
  const std::vector<Pair> many{{box_at(1000), "a"}, {box_at(1001), "b"}};
  CHECK(pairs.insert(many.begin(), many.end()) == 2);
  CHECK(pairs.contains(many[1]));
}

TEST_CASE("a copy that throws changes nothing") {
  {
    spatial::BoundingBoxTernaryTree<Fragile, float, 2> tree;
    for (int i = 0; i < 200; ++i) tree.insert(box_at(i), Fragile(i));
    const auto before = tree.statistics();
    for (int n = 0; n < 200; ++n) {
      Fragile::countdown = n;
      CHECK_THROWS(decltype(tree)(tree));
      const Fragile one(7);
      Fragile::countdown = 0;
      CHECK_THROWS(tree.insert(box_at(7), one));
    }
    Fragile::countdown = -1;
    CHECK(tree.size() == before.elements);
    CHECK(tree.validate().empty());
    std::vector<std::pair<Box, Fragile>> many;
    for (int i = 0; i < 300; ++i) many.push_back({box_at(i), Fragile(i)});
    for (const int n : {0, 5, 299}) {
      Fragile::countdown = n;
      CHECK_THROWS(tree.insert(many.begin(), many.end()));
    }
    Fragile::countdown = -1;
    CHECK(tree.size() == before.elements);
    CHECK(tree.insert(many.begin(), many.end()) == 300);
    CHECK(tree.size() == 500);
    CHECK(tree.validate().empty());
  }
  CHECK(Fragile::alive == 0);
}

TEST_CASE("memory that runs out leaves the tree as it was") {
  Failing memory;
  {
    spatial::pmr::BoundingBoxTernaryTree<int, float, 2> tree(&memory);
    std::mt19937 random(1);
    int failures = 0;
    for (int i = 0; i < 3000; ++i) {
      const Box box = box_at(int(random() % 100000));
      memory.countdown = int(random() % 3);
      try {
        tree.insert(box, i);
      } catch (const std::bad_alloc&) {
        ++failures;
      }
      memory.countdown = int(random() % 2);
      if (i % 3 == 0) {
        const auto handle = tree.begin() == tree.end() ? spatial::Handle{} : tree.begin().handle();
        const std::size_t size = tree.size();
        try {
          tree.move(handle, box);
        } catch (const std::bad_alloc&) {
          ++failures;
        }
        REQUIRE(tree.size() == size);
      }
      memory.countdown = -1;
      if (i % 50 == 0) {
        std::size_t reachable = 0;
        for ([[maybe_unused]] int v : tree) ++reachable;
        REQUIRE(reachable == tree.size());
        REQUIRE(tree.count(spatial::satisfies([](int) { return true; })) == tree.size());
      }
    }
    CHECK(failures > 100);
  }
  CHECK(memory.in_use == 0);
}

TEST_CASE("memory that runs out while a few elements are added leaves none of them") {
  Failing memory;
  spatial::pmr::BoundingBoxTernaryTree<int, float, 2> tree(&memory);
  for (int i = 0; i < 300; ++i) tree.insert(box_at(i), i);
  std::vector<std::pair<Box, int>> many;
  for (int i = 0; i < 299; ++i) many.push_back({box_at(100 * i), 1000 + i});
  int failures = 0;
  for (;; ++failures) {
    memory.countdown = failures;
    try {
      tree.insert(many.begin(), many.end());
      break;
    } catch (const std::bad_alloc&) {
    }
    memory.countdown = -1;
    REQUIRE(tree.size() == 300);
    REQUIRE(tree.count(spatial::satisfies([](int v) { return v >= 1000; })) == 0);
    REQUIRE(tree.validate().empty());
  }
  memory.countdown = -1;
  CHECK(failures > 3);
  CHECK(tree.size() == 599);
}

TEST_CASE("values get the tree's allocator, and trees with different ones can be assigned") {
  Failing one, two;
  {
    using Tree = spatial::pmr::BoundingBoxTernaryTree<std::pmr::string, float, 2>;
    Tree a(&one);
    Tree b(&two);
    for (int i = 0; i < 200; ++i)
      a.insert(box_at(i), std::pmr::string("long enough to be on the heap: " + std::to_string(i)));
    for (const auto& v : a) CHECK(v.get_allocator().resource() == &one);
    b = a;
    CHECK(b.get_allocator().resource() == &two);
    for (const auto& v : b) CHECK(v.get_allocator().resource() == &two);
    a.clear();
    a = std::move(b);
    CHECK(b.empty());
    CHECK(a.size() == 200);
    for (const auto& v : a) CHECK(v.get_allocator().resource() == &one);
    CHECK(a.validate().empty());
    Tree c(a, &two);
    CHECK(c.size() == 200);
  }
  CHECK(one.in_use == 0);
  CHECK(two.in_use == 0);
}

TEST_CASE("handles survive what happens to others, and are known when stale") {
  spatial::BoundingBoxTernaryTree<int, float, 2> tree;
  const auto a = tree.insert(box_at(1), 1);
  const auto b = tree.insert(box_at(2), 2);
  CHECK(tree.erase(a));
  const auto c = tree.insert(box_at(3), 3);
  CHECK(c.index == a.index);
  CHECK_FALSE(tree.contains(a));
  CHECK_FALSE(tree.move(a, box_at(4)));
  CHECK_FALSE(tree.contains(spatial::Handle{}));
  for (int i = 0; i < 1000; ++i) tree.insert(box_at(i), i);
  CHECK(tree.value(b) == 2);
  tree.clear();
  CHECK_FALSE(tree.contains(b));
  const auto d = tree.insert(box_at(5), 5);
  CHECK_FALSE(d == b);
}
