// Box2D's dynamic tree as a peer: `float` in the plane. It keeps each box with a margin of 0.1 (its length of
// a hand), so coordinates are scaled until the mean side of a box is 1, as Box2D means it, and hits are
// tested with the box itself. A move within the margin costs it nothing.
#include <box2d/b2_dynamic_tree.h>

#include <memory>

#include "tree_benchmarks.hpp"

namespace {

template <class T, std::size_t D>
class Box2d {
 public:
  using Box = spatial::Box<T, D>;

  static Box2d one_by_one(const std::vector<Box>& boxes) {
    Box2d result;
    double sides = 0;
    for (const Box& b : boxes) sides += double{b.max[0]} - double{b.min[0]};
    result.scale_ = static_cast<float>(static_cast<double>(boxes.size()) / sides);
    result.boxes_ = boxes;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      result.proxies_.push_back(
          result.tree_->CreateProxy(result.scaled(boxes[i]), reinterpret_cast<void*>(i)));
    return result;
  }
  static Box2d bulk(const std::vector<Box>& boxes) { return one_by_one(boxes); }  // there is no bulk load
  std::size_t query(const Box& q) const {
    struct Hits {
      const Box2d& tree;
      const Box& q;
      std::size_t sum;
      bool QueryCallback(int32 proxy) {
        const auto i = reinterpret_cast<std::size_t>(tree.tree_->GetUserData(proxy));
        if (spatial::touch(tree.boxes_[i], q)) sum += i;
        return true;
      }
    } hits{*this, q, 0};
    tree_->Query(&hits, scaled(q));
    return hits.sum;
  }
  void erase(std::uint32_t i, const Box&) { tree_->DestroyProxy(proxies_[i]); }
  void move(std::uint32_t i, const Box&, const Box& to) {
    boxes_[i] = to;
    tree_->MoveProxy(proxies_[i], scaled(to), b2Vec2(0, 0));
  }

 private:
  b2AABB scaled(const Box& b) const {
    b2AABB result;
    result.lowerBound.Set(b.min[0] * scale_, b.min[1] * scale_);
    result.upperBound.Set(b.max[0] * scale_, b.max[1] * scale_);
    return result;
  }
  std::unique_ptr<b2DynamicTree> tree_ = std::make_unique<b2DynamicTree>();
  std::vector<int32> proxies_;
  std::vector<Box> boxes_;
  float scale_ = 1;
};

}  // namespace

void add_box2d() {
  tree_benchmarks::for_each_scene(1'000'000, [](const std::string& name, std::size_t count) {
    tree_benchmarks::add<float, 2, Box2d>(name, count, "float2", "box2d", false);
  });
}
