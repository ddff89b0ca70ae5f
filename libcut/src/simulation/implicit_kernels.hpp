/// @file
/// The loops of an implicit step's solver, each compiled for any processor and for x86 with AVX2. Both give
/// the same bits: the order of every sum is written down, and products are never fused with sums. Nodes go in
/// fours: `first` and `last` count these, unless it says otherwise.
#pragma once
#include "cut/implicit_work.hpp"

namespace cut {

struct ImplicitKernels {
  /// product = matrix · vector. Returns vector · product.
  double (*multiply)(const ImplicitWork& work, const PaddedVector* vector, PaddedVector* product,
                     std::size_t first, std::size_t last);
  /// Goes `way` along the direction: change and residual. Leaves inverses · residual in `preconditioned`.
  /// Returns Σ |residual|²/m: of impulses, twice the energy that they give to nodes at rest.
  double (*advance)(ImplicitWork& work, double way, std::size_t first, std::size_t last);
  /// residual = right - product, and half of inverses · residual more than `direction` in `preconditioned`.
  void (*approach)(ImplicitWork& work, std::size_t first, std::size_t last);
  /// Adds to free nodes of `preconditioned` what the finest grid says. Returns residual · preconditioned.
  double (*correct)(ImplicitWork& work, std::size_t first, std::size_t last);
  /// direction = preconditioned + part · direction.
  void (*turn)(ImplicitWork& work, double part, std::size_t first, std::size_t last);
  /// to[row] += Σ weight · from[column], for single rows from `first` on.
  void (*add_weighted)(const WeightRows& rows, const PaddedVector* from, PaddedVector* to, std::size_t first,
                       std::size_t last);
};

/// Plain C++.
[[nodiscard]] const ImplicitKernels& portable_implicit_kernels();
/// The fastest that this processor has.
[[nodiscard]] const ImplicitKernels& best_implicit_kernels();

}  // namespace cut
