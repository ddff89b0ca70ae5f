/// @file
/// nanoflann's k-d tree as a peer. In: points, and questions. Out: calls with the indices of what is found.
#pragma once
#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>
#include <spatial/box.hpp>
#include <utility>
#include <vector>

namespace peers {

/// Keeps a reference to its points.
template <class T, std::size_t D>
class Flann {
 public:
  using Point = spatial::Point<T, D>;

  explicit Flann(const std::vector<Point>& points)
      : cloud_{points}, tree_(static_cast<int>(D), cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    tree_.buildIndex();
    unsorted_.sorted = false;
  }
  Flann(const Flann&) = delete;
  Flann& operator=(const Flann&) = delete;

  /// @pre there are k points
  template <class Visit>
  void nearest(const Point& p, unsigned k, const Visit& visit) {
    ids_.resize(k);
    distances_.resize(k);
    tree_.knnSearch(p.data(), k, ids_.data(), distances_.data());
    for (const std::uint32_t i : ids_) visit(i);
  }
  template <class Visit>
  void within(const Point& p, T distance, const Visit& visit) {
    tree_.radiusSearch(p.data(), distance * distance, found_, unsorted_);
    for (const auto& f : found_) visit(f.first);
  }

 private:
  struct Cloud {
    const std::vector<Point>& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    T kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
    template <class B>
    bool kdtree_get_bbox(B&) const {
      return false;
    }
  };
  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<T, Cloud>, Cloud, static_cast<int>(D),
                                      std::uint32_t>
      tree_;
  nanoflann::SearchParams unsorted_;
  std::vector<std::uint32_t> ids_;
  std::vector<T> distances_;
  std::vector<std::pair<std::uint32_t, T>> found_;
};

}  // namespace peers
