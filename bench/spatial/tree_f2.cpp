// The benchmarks of tree_all.hpp for `float` in the plane: a file of its own, since they compile slowly.
#include "tree_all.hpp"

void add_tree_f2() { tree_benchmarks::add_all<float, 2>("float2"); }
