// libspatialindex's R*-tree, all in main memory, as a peer: `double` in the plane and in space.
#include <spatialindex/SpatialIndex.h>

#include <memory>

#include "tree_benchmarks.hpp"

namespace {

namespace si = SpatialIndex;

/// Sums the ids of what is found.
template <class Visit>
class Visitor : public si::IVisitor {
 public:
  explicit Visitor(Visit visit) : visit_(visit) {}
  void visitNode(const si::INode&) override {}
  void visitData(const si::IData& data) override { visit_(static_cast<std::uint32_t>(data.getIdentifier())); }
  void visitData(std::vector<const si::IData*>& all) override {
    for (const si::IData* data : all) visitData(*data);
  }

 private:
  Visit visit_;
};

template <class T, std::size_t D>
class Rtree {
 public:
  using Box = spatial::Box<T, D>;

  static Rtree one_by_one(const std::vector<Box>& boxes) {
    Rtree result;
    si::id_type id = 0;
    result.tree_.reset(
        si::RTree::createNewRTree(*result.memory_, fill, capacity, capacity, D, si::RTree::RV_RSTAR, id));
    for (std::size_t i = 0; i < boxes.size(); ++i)
      result.tree_->insertData(0, nullptr, region(boxes[i]), static_cast<si::id_type>(i));
    return result;
  }
  static Rtree bulk(const std::vector<Box>& boxes) {
    Rtree result;
    Stream stream(boxes);
    si::id_type id = 0;
    result.tree_.reset(si::RTree::createAndBulkLoadNewRTree(si::RTree::BLM_STR, stream, *result.memory_, fill,
                                                            capacity, capacity, D, si::RTree::RV_RSTAR, id));
    return result;
  }
  std::size_t query(const Box& q) const {
    std::size_t sum = 0;
    Visitor visitor([&](std::uint32_t i) { sum += i; });
    tree_->intersectsWithQuery(region(q), visitor);
    return sum;
  }
  template <class Visit>
  void nearest(const spatial::Point<T, D>& p, unsigned k, Visit visit) const {
    Visitor<Visit> visitor(visit);
    tree_->nearestNeighborQuery(k, si::Point(p.data(), D), visitor);
  }
  void erase(std::uint32_t i, const Box& at) { tree_->deleteData(region(at), i); }
  void move(std::uint32_t i, const Box& from, const Box& to) {
    tree_->deleteData(region(from), i);
    tree_->insertData(0, nullptr, region(to), i);
  }

 private:
  static constexpr double fill = 0.7;            // its documentation's
  static constexpr std::uint32_t capacity = 16;  // as Boost's here
  static si::Region region(const Box& b) { return {b.min.data(), b.max.data(), D}; }

  class Stream : public si::IDataStream {
   public:
    explicit Stream(const std::vector<Box>& boxes) : boxes_(boxes) {}
    si::IData* getNext() override {
      auto box = region(boxes_[at_]);
      return new si::RTree::Data(0, nullptr, box, static_cast<si::id_type>(at_++));
    }
    bool hasNext() override { return at_ < boxes_.size(); }
    std::uint32_t size() override { return static_cast<std::uint32_t>(boxes_.size()); }
    void rewind() override { at_ = 0; }

   private:
    const std::vector<Box>& boxes_;
    std::size_t at_ = 0;
  };

  std::unique_ptr<si::IStorageManager> memory_{si::StorageManager::createNewMemoryStorageManager()};
  std::unique_ptr<si::ISpatialIndex> tree_;
};

}  // namespace

void add_spatialindex() {
  tree_benchmarks::for_each_scene(100'000, [](const std::string& name, std::size_t count) {
    for (const bool packed : {false, true}) {
      tree_benchmarks::add<double, 2, Rtree>(name, count, "double2", "libspatialindex", packed);
      tree_benchmarks::add<double, 3, Rtree>(name, count, "double3", "libspatialindex", packed);
    }
  });
}
