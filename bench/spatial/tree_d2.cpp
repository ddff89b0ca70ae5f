#include "tree_all.hpp"

void add_tree_d2() { tree_benchmarks::add_all<double, 2>("double2"); }
