// Tearing: a strip that is pulled apart, cloth that is held stretched, cloth that is not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cut/cutter.hpp>
#include <cut/pieces.hpp>
#include <cut/tearing.hpp>
#include <cut/validate.hpp>
#include <limits>
#include <scenes/cutters.hpp>

#include "simulation/meshes.hpp"

namespace {

/// Stretches along x, and a little unevenly, so that one place is the weakest.
void stretch(cut::HybridMesh& mesh, double factor) {
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const double x = mesh.ancestors.rest_positions[mesh.buffers.nodes[n].index()].x();
    mesh.positions[n].x() = factor * x + 0.01 * x * x;
  }
  mesh.moved();
}

/// One step of tearing with every check.
bool tear(cut::HybridMesh& mesh, cut::Cutter& cutter, cut::Simulation& simulation, double limit) {
  const double mass = simulation.total_mass();
  const auto changes = cutter.cut(mesh, cut::tears(mesh, limit, cutter.distances()));
  REQUIRE(changes.has_value());
  CHECK(cut::validate(mesh, 5).empty());
  CHECK_FALSE(simulation.apply(*changes, mesh).has_value());
  CHECK(simulation.total_mass() == doctest::Approx(mass).epsilon(1e-12));
  return !changes->empty();
}

struct Cloth {
  cut::HybridMesh mesh;
  cut::Simulation simulation;
  cut::Cutter cutter;

  explicit Cloth(const cut::TriangleMesh& input)
      : mesh(testing::built(input)),
        simulation(testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.01, 0, 0})),
        cutter(cut::default_merge_distances(mesh)) {}
};

}  // namespace

TEST_CASE("nothing tears below the limit, at rest, or with a limit that is none") {
  Cloth cloth(scenes::grid(4, 3));
  const auto nothing = [&](double limit) {
    return cut::tears(cloth.mesh, limit, cloth.cutter.distances()).triangles.empty();
  };
  CHECK(nothing(1.0001));
  stretch(cloth.mesh, 1.4);
  CHECK(nothing(1.6));
  CHECK_FALSE(nothing(1.3));
  for (const double limit : {1.0, 0.5, -2.0, std::numeric_limits<double>::quiet_NaN()}) CHECK(nothing(limit));
}

TEST_CASE("a strip with a notch whose ends are pulled apart tears through, from the notch straight across") {
  Cloth cloth(scenes::grid(12, 3, 0.1, scenes::Diagonals::alternating));
  const auto notch = cloth.cutter.cut(cloth.mesh, scenes::plane({0.56, 0, 0}, {0, 0.24, 0}, {0, 0, 1}));
  REQUIRE(notch.has_value());
  REQUIRE_FALSE(cloth.simulation.apply(*notch, cloth.mesh).has_value());
  // Slowly, from just below the limit: a tear goes on by a triangle in a frame, and waves would tear
  // elsewhere.
  cloth.simulation.surroundings.air_drag = 2;
  for (std::size_t n = 0; n < cloth.mesh.positions.size(); ++n) {
    double& x = cloth.mesh.positions[n].x();
    const bool left = x < 0.05, right = x > 1.15;
    x *= 1.3;
    if (!left && !right) continue;
    cloth.simulation.anchor(cut::NodeId{n});
    cloth.simulation.set_velocity(cut::NodeId{n}, {right ? 0.05 : -0.05, 0, 0});
  }
  cloth.mesh.moved();
  int frame = 0;
  for (; frame < 300 && cut::pieces(cloth.mesh).list.size() == 1; ++frame) {
    REQUIRE_FALSE(cloth.simulation.step(cloth.mesh, 0.0005, 20).has_value());
    tear(cloth.mesh, cloth.cutter, cloth.simulation, 1.4);
  }
  const cut::Pieces pieces = cut::pieces(cloth.mesh);
  REQUIRE(pieces.list.size() == 2);
  CHECK(pieces.list[0].rest_area + pieces.list[1].rest_area == doctest::Approx(0.36));
  // The notch is at 0.56 of 1.2, and the tear leads straight across: within half a cell.
  CHECK(pieces.list[1].rest_area > 0.3 * 0.51);
  CHECK(pieces.list[1].rest_area < 0.3 * 0.6);
}

TEST_CASE("cloth that is held stretched stops tearing") {
  for (const auto& input : {scenes::grid(5, 4), scenes::hexagon(3), scenes::twelve_triangles(),
                            scenes::random_sheet(5, 5, 1, 7)}) {
    Cloth cloth(input);
    stretch(cloth.mesh, 2);
    int rounds = 0;
    while (tear(cloth.mesh, cloth.cutter, cloth.simulation, 1.2)) REQUIRE(++rounds < 300);
    CHECK(rounds > 0);
    // The positions of copies are those of their sources, so the cloth is as stretched as before: it has
    // stopped because no fragment renders both ends of a stretched spring.
    CHECK(cut::tears(cloth.mesh, 1.2, cloth.cutter.distances()).triangles.empty());
  }
}

TEST_CASE("tears do not depend on how nodes and triangles are numbered") {
  const cut::TriangleMesh input = scenes::grid(4, 4);
  cut::TriangleMesh renumbered;
  const std::size_t count = input.positions.size();
  renumbered.positions.resize(count);
  const auto number = [&](std::uint32_t n) { return static_cast<std::uint32_t>((n * 7u + 3u) % count); };
  for (std::uint32_t n = 0; n < count; ++n) renumbered.positions[number(n)] = input.positions[n];
  for (const auto& t : input.triangles)
    renumbered.triangles.insert(renumbered.triangles.begin(), {number(t[1]), number(t[2]), number(t[0])});
  std::array<std::vector<double>, 2> areas;
  std::size_t k = 0;
  for (const cut::TriangleMesh& mesh : {input, renumbered}) {
    Cloth cloth(mesh);
    stretch(cloth.mesh, 1.5);
    for (int round = 0; round < 10; ++round) tear(cloth.mesh, cloth.cutter, cloth.simulation, 1.3);
    for (const cut::Piece& p : cut::pieces(cloth.mesh).list) areas[k].push_back(p.rest_area);
    ++k;
  }
  CHECK(areas[0].size() > 1);
  CHECK(areas[0] == areas[1]);
}
