// The benchmarks of tree_all.hpp for `double` in the plane: a file of its own, since they compile slowly.
#include "tree_all.hpp"

void add_tree_d2() { tree_benchmarks::add_all<double, 2>("double2"); }
