// One scene for each fault that was found and put right.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <scenes/random.hpp>

#include "cut/cutter.hpp"
#include "cut/pieces.hpp"
#include "cut/simulation.hpp"
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

namespace {

using Stroke = std::array<double, 4>;  // from x, y to x, y

/// Upright cuts through one square, with merge distances of some lattice units.
HybridMesh cut_by(const std::vector<Stroke>& strokes, double units) {
  HybridMesh mesh = *HybridMesh::build(scenes::grid(1, 1));
  const double d = units * std::sqrt(2.0) / lattice_size;
  Cutter cutter(*checked({d, d, d}, mesh));
  for (const auto& [x0, y0, x1, y1] : strokes) {
    REQUIRE(cutter.cut(mesh, scenes::ribbon({{x0, y0, 0}, {x1, y1, 0}}, {0, 0, 2})).has_value());
    CHECK(validate(mesh).empty());
  }
  return mesh;
}

}  // namespace

TEST_CASE("a node that comes to lie on one cut leads the cuts beside it through its cell") {
  // Merge distances near a lattice cell. The graph was no longer planar: the first crashed, the others filled
  // the memory.
  cut_by({{-2.453183375002747, -0.5982549456579688, 3.0731825192158597, 1.7382552732833867},
          {0.3099984217973059, 0.5700004594423419, 0.31000167707879295, 0.5699999992047983},
          {-2.3347371710062386, 1.9861100961292872, 2.9547366029134667, -0.8461093860111109},
          {1.9124317746725263, -1.9661806073786, -1.292432075776559, 3.1061805489355545},
          {0.3099986251987594, 0.5699992262813827, 0.31000165332963026, 0.570000506554629},
          {-2.4531833242712846, -0.5982548356317438, 3.073182723952222, 1.7382550190537667}},
         1.5);
  cut_by({{0.30999895417903467, 0.5699989413074269, 0.3100019823099671, 0.5700002215805275},
          {-2.4531826915058246, -0.5982552883665537, 3.073183205800723, 1.7382549232711346},
          {0.3099985781596109, 0.5699989176163355, 0.31000151092203937, 0.5700004034092868},
          {-2.4531832495941686, -0.598254617394103, 3.0731828158886447, 1.738255196469303},
          {-2.4531832859099065, -0.5982554555059417, 3.0731826445345405, 1.73825467775325},
          {0.3100013303644386, 0.5699992980391795, 0.30999885497857477, 0.5700014616336382}},
         1.5);
  cut_by({{2.8545722473027957, 2.159072628937855, -2.234572768512701, -1.0190719568228832},
          {0.30999965978366134, 0.5699988162169777, 0.31000004704941014, 0.5700010590979364},
          {-2.4009990012990343, 1.8547121160370985, 3.0209984339069837, -0.7147126858630013},
          {-2.4531828840950807, -0.5982551944926955, 3.073183051366958, 1.7382549268987744},
          {-2.6784835368208046, 0.30738293329489574, 3.2984830383462693, 0.8326167472630982},
          {-2.453183299934211, -0.5982551746071131, 3.0731827137237815, 1.7382547618335327},
          {-2.4531829941569696, -0.5982549015806807, 3.0731829671977704, 1.7382551585687938},
          {-2.453183318871614, -0.5982552822682682, 3.073182747058334, 1.7382545305375636},
          {0.30999889798803815, 0.569999759619787, 0.3100009943863459, 0.570000645962774},
          {-2.4531829032126606, -0.5982548695753345, 3.0731832796442853, 1.7382546666720893},
          {-2.4531832162575813, -0.5982553517618446, 3.073182589182164, 1.7382550771612353}},
         1.5);
}

TEST_CASE("no fragment vanishes however small the merge distances") {
  // Rounding once left nothing of fragments, and nodes that belonged to no triangle.
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    scenes::Random random(seed);
    HybridMesh mesh = *HybridMesh::build(scenes::grid(1, 1));
    const double unit = std::sqrt(2.0) / lattice_size;
    const double d = unit * (seed % 2 == 0 ? 1.02 : 3);
    Cutter cutter({d, d, d});
    auto simulation = *Simulation::build(mesh, Material{});
    const double mass = simulation.total_mass();
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d p(0.31 + random.between(-8, 8) * unit, 0.57 + random.between(-8, 8) * unit, 0);
      const double length = random.below(4) == 0 ? 24 * unit : 3;
      const Eigen::Vector3d way = length * Eigen::Vector3d(random.between(-1, 1), random.between(-1, 1), 0);
      const auto changes = cutter.cut(mesh, scenes::ribbon({p - way, p + way}, {0, 0, 2}));
      REQUIRE(changes.has_value());
      REQUIRE_FALSE(simulation.apply(*changes, mesh));
      REQUIRE(validate(mesh).empty());
      CHECK(simulation.total_mass() == doctest::Approx(mass).epsilon(1e-12));
    }
  }
}

TEST_CASE("a mesh that is set back to an earlier state is cut anew") {
  HybridMesh mesh = *HybridMesh::build(scenes::grid(4, 4));
  Cutter cutter(default_merge_distances(mesh));
  const TriangleMesh blade = scenes::ribbon({{-1, 1.3, 0}, {5, 2.6, 0}}, {0, 0, 2});
  const HybridMesh uncut = mesh;
  REQUIRE(cutter.cut(mesh, blade).has_value());
  mesh = uncut;
  REQUIRE(cutter.cut(mesh, blade).has_value());
  CHECK(pieces(mesh).list.size() == 2);

  // As many calls to moved() as before, but the nodes are elsewhere.
  const auto lift = [&](double z) {
    mesh = uncut;
    for (Eigen::Vector3d& p : mesh.positions) p.z() += z;
    mesh.moved();
  };
  lift(10);
  const TriangleMesh nowhere = scenes::ribbon({{50, 1.3, 0}, {55, 2.6, 0}}, {0, 0, 2});
  for (int i = 0; i < 2; ++i) REQUIRE(cutter.cut(mesh, nowhere).has_value());  // the second builds the tree
  lift(0.01);
  REQUIRE(cutter.cut(mesh, blade).has_value());
  CHECK(pieces(mesh).list.size() == 2);
}

TEST_CASE("a point of the cutter that no triangle names does not matter, wherever it is") {
  for (const double far : {1e30, std::numeric_limits<double>::infinity()}) {
    HybridMesh mesh = *HybridMesh::build(scenes::grid(4, 4));
    Cutter cutter(default_merge_distances(mesh));
    TriangleMesh blade = scenes::ribbon({{-1, 1.3, 0}, {5, 2.6, 0}}, {0, 0, 2});
    blade.positions.emplace_back(far, 0, 0);
    REQUIRE(cutter.cut(mesh, blade).has_value());
    CHECK(pieces(mesh).list.size() == 2);
  }
}

TEST_CASE("many slits in one place do not take the square of their number") {
  constexpr int slits = 30000;
  std::vector<TriangleMesh> ribbons;
  for (int i = 0; i < slits; ++i) {
    // Around the middle of the common edge, which attracts many of their ends.
    const Eigen::Vector3d from(5 + 0.25 * std::sin(7 * i), 5 + 0.25 * std::sin(11 * i), 0);
    ribbons.push_back(scenes::ribbon({from, from + Eigen::Vector3d(0.01, 0.003 * (i % 5), 0)}, {0, 0, 2}));
  }
  HybridMesh mesh = *HybridMesh::build(scenes::grid(1, 1, 10));
  Cutter cutter(default_merge_distances(mesh));
  REQUIRE(cutter.cut(mesh, scenes::joined(ribbons)).has_value());
  CHECK(validate(mesh).empty());
}

TEST_CASE("a long zigzag in one triangle takes neither the stack nor the square of its length") {
  scenes::Path path;
  constexpr int turns = 90000;
  for (int i = 0; i <= turns; ++i) {
    const double t = static_cast<double>(i) / turns;
    path.emplace_back(5.5 + 3 * t, 2.2 + (i % 2 == 0 ? -2 : 2) * t, 0);
  }
  HybridMesh mesh = *HybridMesh::build(scenes::grid(1, 1, 10));
  Cutter cutter(default_merge_distances(mesh));
  REQUIRE(cutter.cut(mesh, scenes::ribbon(path, {0, 0, 2})).has_value());
  CHECK(validate(mesh).empty());
}

TEST_CASE("triangles that are nearly needles are cut without violations") {
  // Products of lengths cancel in them: corners of cutters once landed outside of the lattice, and a crumb
  // without length was welded for ever.
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    scenes::Random random(seed);
    const auto direction = [&] {
      return Eigen::Vector3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    };
    const Eigen::Vector3d from = direction(), along = direction(), aside = direction();
    const double width = std::pow(10.0, random.between(-13, -2));
    const Eigen::Vector3d tip = from + random.between(0.01, 0.99) * along + width * aside;
    const TriangleMesh needle{{from, from + along, tip, tip + width * aside}, {{0, 1, 2}, {0, 2, 3}}};
    auto mesh = HybridMesh::build(needle);
    if (!mesh) {
      CHECK(mesh.error().kind == Error::Kind::degenerate_triangle);
      continue;
    }
    MergeDistances d = default_merge_distances(*mesh);
    if (random.below(2) == 0) d.cut = d.node = d.edge = 4 * along.norm() / lattice_size;
    Cutter cutter(d);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d through =
          from + random.between(0, 1) * along + random.between(-1, 1) * width * aside;
      const Eigen::Vector3d u = along + std::pow(10.0, random.between(-12, 0)) * aside;
      REQUIRE(cutter.cut(*mesh,
                         scenes::plane(through, 2 * (random.below(4) == 0 ? direction() : u), direction())));
      const auto found = validate(*mesh, 1);
      if (!found.empty()) FAIL(found[0].rule << ": " << found[0].message);
    }
  }
}

TEST_CASE("a thousand random cuts within one triangle, at once and once more across") {
  // 3000 took 38 s, the square of what is there in three places.
  HybridMesh mesh = *HybridMesh::build({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  scenes::Random random(5);
  TriangleMesh soup;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Eigen::Vector3d centre(random.between(-0.3, 1), random.between(-0.3, 1), 0);
    for (int k = 0; k < 3; ++k)
      soup.positions.push_back(
          centre + Eigen::Vector3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Cutter cutter({1e-5, 1e-5, 1e-5});
  REQUIRE(cutter.cut(mesh, soup).has_value());
  CHECK(validate(mesh).empty());
  CHECK(pieces(mesh).list.size() > 1000);
  REQUIRE(cutter.cut(mesh, scenes::ribbon({{-1, 0.31, 0}, {2, 0.37, 0}}, {0, 0, 2})).has_value());
  CHECK(validate(mesh).empty());
}

TEST_CASE("small triangles in a coarse mesh are cut where the cutter meets them") {
  // The merge distances are a part of the mean edge: 1 mm squares beside one triangle of 1 km merged with all
  // that was cut in them, into 9 pieces.
  const TriangleMesh fine = scenes::grid(10, 10, 1e-3);
  const TriangleMesh coarse{{{0, 0, 5}, {1000, 0, 5}, {0, 1000, 5}}, {{0, 1, 2}}};
  const TriangleMesh blade = scenes::plane({0.0031, 0.0041, 0}, {2000, 300, 0}, {0, 0, 100});
  const auto areas = [&](const TriangleMesh& cloth, const MergeDistances* distances) {
    HybridMesh mesh = *HybridMesh::build(cloth);
    Cutter cutter(distances != nullptr ? *distances : default_merge_distances(mesh));
    REQUIRE(cutter.cut(mesh, blade).has_value());
    CHECK(validate(mesh).empty());
    std::vector<double> result;
    for (const Piece& piece : pieces(mesh).list) result.push_back(piece.rest_area);
    std::sort(result.begin(), result.end());
    return result;
  };
  const std::vector<double> alone = areas(fine, nullptr);
  REQUIRE(alone.size() == 2);
  // The line y = 0.0041 + 0.15 (x - 0.0031) through the square of 10 mm.
  CHECK(alone[0] == doctest::Approx(0.01 * (0.0041 + 0.15 * (0.005 - 0.0031))).epsilon(0.02));
  const std::vector<double> both = areas(scenes::joined({fine, coarse}), nullptr);
  REQUIRE(both.size() == 4);
  CHECK(both[0] == doctest::Approx(alone[0]).epsilon(0.05));
  CHECK(both[1] == doctest::Approx(alone[1]).epsilon(0.05));
  const MergeDistances large{1.4e-3, 1.4e-3, 1.4e-3};  // an edge
  const std::vector<double> merged = areas(fine, &large);
  REQUIRE(merged.size() == 2);
  CHECK(merged[0] == doctest::Approx(alone[0]).epsilon(0.1));
}

TEST_CASE(
    "a polygon that touches itself in a node of its side keeps its triangles when its angles there part") {
  // A triangle is cut out of the upper triangle, with its tip on the common edge; then a slit in the lower
  // triangle ends at that tip. The two angles beside the tip no longer share a vertex, in a polygon that this
  // cut does not arrange anew.
  HybridMesh mesh =
      *HybridMesh::build({{{-2, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, -2, 0}}, {{0, 1, 2}, {1, 0, 3}}});
  Cutter cutter({0.1, 0.05, 0.025});
  REQUIRE(cutter.cut(mesh, scenes::tube({{0, 0, 0}, {0.3, 0.5, 0}, {-0.3, 0.5, 0}}, {0, 0, 2})).has_value());
  REQUIRE(validate(mesh).empty());
  REQUIRE(cutter.cut(mesh, scenes::ribbon({{0.1, -3, 0}, {0, -0.02, 0}}, {0, 0, 2})).has_value());
  CHECK(validate(mesh).empty());
  REQUIRE(pieces(mesh).list.size() == 2);
  CHECK(pieces(mesh).list[0].boundary_loops == 1);
  CHECK(pieces(mesh).list[0].euler_characteristic == 1);
}

TEST_CASE("an end on a cut that leaves a side at a small angle may be rounded onto that side") {
  // δe is a unit of the lattice. The end was a node inside of the triangle, which lay on its side.
  HybridMesh mesh = *HybridMesh::build({{{0, 0, 4.1968370097030752},
                                         {-0.76977410168158789, -0.63831640459908623, 0},
                                         {0.36920169680273524, -0.9293492922889548, 0},
                                         {0.99795329900981167, 0.063946954543851561, 0},
                                         {0.24756736117041525, 0.96887068367409956, 0},
                                         {-0.84494825530137407, 0.53484805867008989, 0},
                                         {0, 0, -4.1968370097030752}},
                                        {{0, 1, 2},
                                         {0, 2, 3},
                                         {0, 3, 4},
                                         {0, 4, 5},
                                         {0, 5, 1},
                                         {6, 2, 1},
                                         {6, 3, 2},
                                         {6, 4, 3},
                                         {6, 5, 4},
                                         {6, 1, 5}}});
  Cutter cutter({5.5640318482796972e-07, 5.5640318482796972e-07, 1.2986281549080431e-07});
  const std::array<TriangleMesh, 2> cutters{
      {{{{-0.43232377275234268, 0.2736587379347199, -8.5856433882222465},
         {-0.43232377275234268, 0.2736587379347199, 4.4866631900751468},
         {4.633711209183422e-07, -6.6205689032033725e-07, -2.3393154976242219},
         {4.633711209183422e-07, -6.6205689032033725e-07, 10.732991080673171}},
        {{0, 1, 3}, {0, 3, 2}}},
       {{{-0.43232350311876938, 0.27365855940081524, -8.5856432211783762},
         {-0.43232350311876938, 0.27365855940081524, 4.4866633571190162},
         {-0.43232321161536125, 0.27365836638612112, -8.5856430405856692},
         {-0.43232321161536125, 0.27365836638612112, 4.4866635377117241}},
        {{0, 1, 3}, {0, 3, 2}}}}};
  for (const TriangleMesh& blade : cutters) {
    REQUIRE(cutter.cut(mesh, blade).has_value());
    CHECK(validate(mesh).empty());
  }
}
