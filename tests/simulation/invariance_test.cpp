// Whether a cut cloth is still the same cloth, measured by how it swings and how stiff it is in its plane: no
// cut makes it stiffer, and what a slit changes, against element refinement (the paper's Figure 1) and
// against the same slit in a much finer mesh.
#include <doctest/doctest.h>

#include <cmath>
#include <cut/cutter.hpp>
#include <cut/pieces.hpp>
#include <cut/validate.hpp>
#include <iomanip>
#include <numbers>
#include <scenes/cutters.hpp>
#include <sstream>

#include "simulation/documents.hpp"
#include "simulation/linear.hpp"
#include "simulation/meshes.hpp"

using cut::MaterialMode;

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// The rim of a hexagon whose sides have this length.
testing::Held rim(double side) {
  return [=](const Eigen::Vector3d& p) {
    for (const double degrees : {30.0, 90.0, 150.0}) {
      const double across = p.x() * std::cos(radians(degrees)) + p.y() * std::sin(radians(degrees));
      if (std::abs(across) > side * std::sqrt(3.0) / 2 - 1e-6) return true;
    }
    return false;
  };
}

cut::TriangleMesh slit_cutter(const Eigen::Vector3d& centre, double degrees, double length) {
  const Eigen::Vector3d along(std::cos(radians(degrees)), std::sin(radians(degrees)), 0);
  return scenes::plane(centre, length * along, {0, 0, 1});
}

/// What the tests compare.
struct Measured {
  std::vector<double> frequencies, energies;
  double time_step;
  std::size_t nodes;
};

/// @param degrees  directions of the stretches
Measured measure(const cut::HybridMesh& mesh, MaterialMode mode, double side,
                 const std::vector<double>& degrees) {
  const cut::Simulation simulation = testing::simulated(mesh, {mode});
  return {testing::frequencies(mesh, simulation, rim(side), 4),
          testing::stretch_energies(mesh, simulation, rim(side), degrees),
          simulation.stable_time_step(cut::Integrator::semi_implicit_euler), mesh.positions.size()};
}

// --- A slit in a hexagon of 216 triangles

constexpr double side = 6;
constexpr std::array from_slit{0.0, 30.0, -30.0, 60.0, -60.0, 90.0};

struct Slit {
  double length, degrees;
  Measured uncut, ours, refined, fine_uncut, fine;
};

/// @param length  in edges of the coarse mesh
Slit measure_slit(double length, double degrees) {
  std::vector<double> directions;
  for (const double angle : from_slit) directions.push_back(degrees + angle);
  Slit slit{length, degrees, {}, {}, {}, {}, {}};
  const auto cut_mesh = [&](std::size_t fineness, Measured& before, Measured& after) {
    const auto rings = static_cast<std::size_t>(side) * fineness;
    cut::HybridMesh mesh = testing::built(scenes::hexagon(rings, 1 / static_cast<double>(fineness)));
    before = measure(mesh, MaterialMode::conserving, side, directions);
    cut::Cutter cutter(cut::default_merge_distances(mesh));
    REQUIRE(cutter.cut(mesh, slit_cutter({0.23, 0.31, 0}, degrees, length)));
    REQUIRE(cut::validate(mesh, 1).empty());
    REQUIRE(cut::pieces(mesh).list.size() == 1);
    after = measure(mesh, MaterialMode::conserving, side, directions);
    return mesh;
  };
  const cut::HybridMesh mesh = cut_mesh(1, slit.uncut, slit.ours);
  slit.refined = measure(testing::refined(mesh), MaterialMode::conserving, side, directions);
  cut_mesh(4, slit.fine_uncut, slit.fine);
  return slit;
}

std::string table(const std::vector<Slit>& slits) {
  std::ostringstream text;
  text << "| slit | mesh | ω₁ | ω₂ | ω₃ | ω₄ | 0° | +30° | −30° | +60° | −60° | 90° | nodes | step |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
       << std::fixed << std::setprecision(1);
  for (const Slit& slit : slits) {
    const auto row = [&](const char* name, const Measured& m, const Measured& uncut) {
      text << "| " << std::setprecision(0) << slit.length << ", " << slit.degrees << "° | " << name << " |"
           << std::setprecision(1);
      for (std::size_t i = 0; i < m.frequencies.size(); ++i)
        text << ' ' << 100 * m.frequencies[i] / uncut.frequencies[i] << " |";
      for (std::size_t i = 0; i < m.energies.size(); ++i)
        text << ' ' << 100 * m.energies[i] / uncut.energies[i] << " |";
      text << ' ' << m.nodes << " | " << 100 * m.time_step / uncut.time_step << " |\n";
    };
    row("ours", slit.ours, slit.uncut);
    row("element refinement", slit.refined, slit.uncut);
    row("ours, 16 times finer", slit.fine, slit.fine_uncut);
  }
  return text.str();
}

/// The E-shaped cutter of the paper's second experiment in both modes.
std::string modes_table() {
  std::ostringstream text;
  text
      << "| mode | mass | centre of mass moves by | anchored nodes | stable time step over the cut-proof one "
         "|\n|---|---|---|---|---|\n"
      << std::fixed;
  for (const MaterialMode mode : {MaterialMode::conserving, MaterialMode::paper}) {
    cut::HybridMesh mesh = testing::built(scenes::twelve_triangles());
    cut::Simulation simulation = testing::simulated(mesh, {mode});
    for (const unsigned n : {0u, 4u, 8u, 3u, 7u, 11u}) simulation.anchor(cut::NodeId{n});
    const double mass = simulation.total_mass();
    const Eigen::Vector3d centre = simulation.centre_of_mass(mesh);
    const auto spare = [&] {
      return simulation.stable_time_step(cut::Integrator::semi_implicit_euler) /
             simulation.cut_proof_time_step(cut::Integrator::semi_implicit_euler, mesh);
    };
    const double spare_before = spare();
    cut::Cutter cutter(cut::default_merge_distances(mesh));
    const auto changes =
        cutter.cut(mesh, scenes::e_shape({0.6, 0.2, 0}, {0, 1.2, 0}, {1.4, 0, 0}, {0, 0, 2}));
    REQUIRE(changes);
    REQUIRE_FALSE(simulation.apply(*changes, mesh));
    std::size_t anchored = 0;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) anchored += simulation.anchored(cut::NodeId{n});
    text << "| " << (mode == MaterialMode::paper ? "`paper`" : "`conserving`") << " | "
         << std::setprecision(1) << 100 * simulation.total_mass() / mass << " % | " << std::setprecision(3)
         << (simulation.centre_of_mass(mesh) - centre).norm() << " sides | 6, then " << anchored << " | "
         << std::setprecision(2) << spare_before << ", then " << spare() << " |\n";
  }
  return text.str();
}

/// How different a slit makes the stiffness on its two sides, as a part of the uncut one.
double unevenness(const Measured& m, const Measured& uncut) {
  return std::max(std::abs(m.energies[1] - m.energies[2]), std::abs(m.energies[3] - m.energies[4])) /
         uncut.energies[0];
}

}  // namespace

TEST_CASE("No cut makes cloth swing faster or resist more in any direction; in paper mode cuts do") {
  const std::vector<double> directions{0, 25, 60, 90, 140};
  bool paper_stiffens = false;
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const MaterialMode mode : {MaterialMode::conserving, MaterialMode::paper}) {
      std::mt19937 random(seed);
      cut::HybridMesh mesh = testing::built(scenes::hexagon(3));
      cut::Cutter cutter(cut::default_merge_distances(mesh));
      Measured before = measure(mesh, mode, 3, directions);
      for (int c = 0; c < 5; ++c) {
        const Eigen::Vector3d centre =
            testing::random_vector(random, 2).cwiseProduct(Eigen::Vector3d(1, 1, 0));
        const double degrees = testing::random_vector(random, 180).x();
        REQUIRE(cutter.cut(mesh, slit_cutter(centre, degrees, 0.5 + static_cast<double>(random() % 4))));
        REQUIRE(cut::validate(mesh, 1).empty());
        Measured after = measure(mesh, mode, 3, directions);
        for (std::size_t i = 0; i < directions.size(); ++i) {
          const bool stiffer = after.energies[i] > before.energies[i] * (1 + 1e-9);
          if (mode == MaterialMode::paper) paper_stiffens |= stiffer;
          if (mode == MaterialMode::conserving) CHECK_FALSE(stiffer);
        }
        for (std::size_t i = 0; mode == MaterialMode::conserving && i < before.frequencies.size(); ++i)
          CHECK(after.frequencies[i] <= before.frequencies[i] * (1 + 1e-6) + 1e-3);
        before = std::move(after);
      }
    }
  CHECK(paper_stiffens);
}

TEST_CASE("A slit against element refinement and against a finer mesh, and both modes: docs/material.md") {
  const std::vector<Slit> slits{measure_slit(2, 90), measure_slit(6, 90), measure_slit(6, 17)};
  const std::string now = table(slits);
  CHECK_MESSAGE(testing::page("material.md").find(now) != std::string::npos, now);
  const std::string modes = modes_table();
  CHECK_MESSAGE(testing::page("material.md").find(modes) != std::string::npos, modes);
  for (const Slit& slit : slits) {
    CHECK(slit.ours.time_step >= slit.uncut.time_step * (1 - 1e-12));
    CHECK(slit.refined.time_step < 0.5 * slit.uncut.time_step);
    CHECK(unevenness(slit.ours, slit.uncut) < unevenness(slit.refined, slit.uncut));
    CHECK(slit.refined.frequencies[1] > slit.uncut.frequencies[1]);  // which no slit can do
    for (std::size_t i = 0; i < from_slit.size(); ++i)
      CHECK(std::abs(slit.ours.energies[i] / slit.uncut.energies[i] -
                     slit.fine.energies[i] / slit.fine_uncut.energies[i]) < 0.17);
  }
}
