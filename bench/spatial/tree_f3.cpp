// The benchmarks of tree_all.hpp for `float` in space: a file of its own, since they compile slowly.
#include "tree_all.hpp"

void add_tree_f3() { tree_benchmarks::add_all<float, 3>("float3"); }
