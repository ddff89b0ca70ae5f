/// @file
/// Every point and box type that Boost.Geometry knows, its own and those registered with it.
#pragma once
#include <boost/geometry/core/access.hpp>
#include <boost/geometry/core/coordinate_dimension.hpp>
#include <boost/geometry/core/coordinate_type.hpp>
#include <boost/geometry/core/tag.hpp>
#include <boost/geometry/core/tags.hpp>
#include <utility>

#include "../box.hpp"

namespace spatial {

namespace detail {

template <std::size_t Corner, class G, std::size_t... Axes>
auto boost_coordinate(const G& g, std::size_t axis, std::index_sequence<Axes...>) {
  typename boost::geometry::coordinate_type<G>::type result{};
  if constexpr (std::is_same_v<typename boost::geometry::tag<G>::type, boost::geometry::box_tag>) {
    ((axis == Axes ? void(result = boost::geometry::get<Corner, Axes>(g)) : void()), ...);
  } else {
    ((axis == Axes ? void(result = boost::geometry::get<Axes>(g)) : void()), ...);
  }
  return result;
}

template <class G>
concept BoostGeometry = std::is_same_v<typename boost::geometry::tag<G>::type, boost::geometry::box_tag> ||
                        std::is_same_v<typename boost::geometry::tag<G>::type, boost::geometry::point_tag>;

}  // namespace detail

template <detail::BoostGeometry G>
struct GeometryTraits<G> {
  using Scalar = typename boost::geometry::coordinate_type<G>::type;
  static constexpr std::size_t dimension = boost::geometry::dimension<G>::value;
  static Scalar min(const G& g, std::size_t axis) {
    return detail::boost_coordinate<boost::geometry::min_corner>(g, axis,
                                                                 std::make_index_sequence<dimension>());
  }
  static Scalar max(const G& g, std::size_t axis) {
    return detail::boost_coordinate<boost::geometry::max_corner>(g, axis,
                                                                 std::make_index_sequence<dimension>());
  }
};

}  // namespace spatial
