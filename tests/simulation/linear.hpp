/// @file
/// Small motions of a simulated cloth in its plane: frequencies, and how stiff it is in each direction. In: a
/// flat mesh at rest and its simulation. Out: numbers that belong to the material, and should not change by a
/// cut that opens little.
#pragma once
#include <cut/hybrid_mesh.hpp>
#include <cut/simulation.hpp>
#include <functional>
#include <vector>

namespace testing {

/// Which nodes are held, by their tension-free position.
using Held = std::function<bool(const Eigen::Vector3d&)>;

/// The lowest frequencies ω [1/s] in the plane z = 0.
std::vector<double> frequencies(const cut::HybridMesh& mesh, const cut::Simulation& simulation,
                                const Held& held, std::size_t count);

/// Energy of the cloth when its held nodes are moved by a stretch of 1 along each of these directions
/// [degrees from x], and all others are where that costs least.
std::vector<double> stretch_energies(const cut::HybridMesh& mesh, const cut::Simulation& simulation,
                                     const Held& held, const std::vector<double>& directions);

/// The cut mesh as element refinement would simulate it (the paper's Figure 1): each render triangle of the
/// tension-free cloth is a physics triangle of its own.
cut::HybridMesh refined(const cut::HybridMesh& mesh);

}  // namespace testing
