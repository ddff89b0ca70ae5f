#include "tree_all.hpp"

void add_tree_f2() { tree_benchmarks::add_all<float, 2>("float2"); }
