// One scene for each fault that was found and put right.
#include <doctest/doctest.h>

#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>

#include "cut/cutter.hpp"
#include "cut/validate.hpp"

using namespace cut;

TEST_CASE("a triangle that only its edge's new node concerns is looked up by its old nodes") {
  // The line's end merges onto an edge; the triangle beyond it has no line and did not have that node yet.
  // Its stamps were once written past the end of its nodes, which the address sanitizer tells.
  HybridMesh mesh = *HybridMesh::build(scenes::fan(9, 2));
  Cutter cutter(default_merge_distances(mesh));
  const auto cut = cutter.cut(mesh, scenes::ribbon({{1.7026360823828581, 0.035303244416173468, 0},
                                                    {1.619744866130151, 0.038686346117833392, 0}},
                                                   {0.1, -0.05, 2}));
  REQUIRE(cut.has_value());
  CHECK(validate(mesh).empty());
}
