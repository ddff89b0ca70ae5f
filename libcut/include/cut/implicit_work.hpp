/// @file
/// The linear system of an implicit step (docs/simulation.md, "The implicit step"), and work space for
/// solving it. Flat arrays, by nodes in fours: what is side by side is computed at once.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "cut/padded_vector.hpp"
#include "cut/spring_blocks.hpp"

namespace cut {

/// A sparse matrix of numbers >= 0, row by row.
struct WeightRows {
  std::vector<std::uint32_t> begins{0};  ///< per row (+1): where it starts in the other two
  std::vector<std::uint32_t> columns;
  std::vector<double> weights;
};

/// A symmetric 3x3 matrix: xx, yy, zz, xy, yz, zx.
using SymmetricBlock = std::array<double, 6>;

/// Functions on the cloth that are 1 at a point of a coarse grid and fall off evenly to 0 at its neighbours.
/// Where cuts have divided what is around such a point, each part has a function of its own.
struct CoarseGrid {
  WeightRows from_finer;  ///< a row for each function: the values at the nodes of the next finer grid
  WeightRows to_finer;    ///< the same matrix transposed
  WeightRows at_nodes;    ///< a row for each node of the cloth: the functions there
  std::vector<SymmetricBlock> inverses;  ///< per function: of its block of the system's diagonal
  std::vector<PaddedVector> residual, correction;
};

struct ImplicitWork {
  /// h²·(−∂f/∂p) + h·(−∂f/∂v) between the two ends of each of four springs: across·I + along·d·dᵀ, positive
  /// semidefinite, with the unit vector d along the spring.
  struct alignas(32) FourCouplings {
    std::array<double, 4> x{}, y{}, z{}, along{}, across{};
  };
  /// SymmetricBlock of four nodes.
  struct alignas(32) FourBlocks {
    std::array<std::array<double, 4>, 6> values{};
  };
  /// A node that touches an obstacle, or would without the contact.
  struct Contact {
    std::uint32_t node;
    double friction;
    Eigen::Vector3d normal;
    double least;              ///< velocity along the normal that keeps the node out
    Eigen::Vector3d velocity;  ///< of the obstacle
    double limit;              ///< for the impulse of friction
    double stiffness;          ///< no less than any eigenvalue of the node's block of the diagonal
  };

  // Found anew after a cut.
  std::uint64_t topology_version = ~std::uint64_t{0};  ///< of the mesh that this is for
  std::vector<std::uint32_t> row_begins;  ///< per four nodes (+1): where their springs start in ...
  std::vector<std::array<std::uint32_t, 4>> others;  ///< ... the other ends of a spring of each; itself: none
  std::vector<FourSprings> springs;                  ///< ... and their constants
  std::vector<CoarseGrid> grids;                     ///< finest first

  // The system of a step.
  std::vector<FourCouplings> couplings;      ///< as `springs`; 0 in rows of nodes that are held
  std::vector<FourBlocks> blocks, inverses;  ///< mass and drag; the inverse of that with the springs'
  std::vector<double> inverse_mass;          ///< 0: held

  // Per node, and up to three more.
  std::vector<PaddedVector> change, right, residual, preconditioned, direction, product;
  std::vector<double> sums;  ///< per range of nodes

  std::vector<Contact> contacts;
  std::vector<std::uint8_t> touches;  ///< per node: whether it is in `contacts`
};

}  // namespace cut
