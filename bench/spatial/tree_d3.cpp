// The benchmarks of tree_all.hpp for `double` in space: a file of its own, since they compile slowly.
#include "tree_all.hpp"

void add_tree_d3() { tree_benchmarks::add_all<double, 3>("double3"); }
