#include "tree_all.hpp"

void add_tree_d3() { tree_benchmarks::add_all<double, 3>("double3"); }
