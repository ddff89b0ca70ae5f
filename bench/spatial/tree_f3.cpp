#include "tree_all.hpp"

void add_tree_f3() { tree_benchmarks::add_all<float, 3>("float3"); }
