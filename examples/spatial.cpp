#include <cstdio>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <spatial/point_cluster_dictionary.hpp>
#include <string>

int main() {
  using Box = spatial::Box<double, 2>;
  spatial::BoundingBoxTernaryTree<std::string, double, 2> tree;
  tree.insert(Box{{0, 0}, {4, 3}}, "house");
  const spatial::Handle car = tree.insert(Box{{6, 1}, {8, 2}}, "car");
  tree.move(car, Box{{3, 1}, {5, 2}});
  const auto near = spatial::nearest(spatial::Point<double, 2>{6, 1.5}, 2);
  for (const std::string& name : tree.query(near)) std::printf("%s\n", name.c_str());

  spatial::PointClusterDictionary<double, 2, const char*> towns(0.1);  // merges within 0.1
  towns.insert_or_merge({1.00, 1.00}, "here");
  const spatial::MergeResult merged = towns.insert_or_merge({1.05, 0.98}, "there");
  std::printf("%s, %zu in all\n", towns.value(merged.cluster), towns.size());
}
