/// @file
/// Coarse grids for the solver of an implicit step. In: a mesh, cut or not; then the system of a step. Out:
/// what moves whole parts of the cloth at once, which conjugate gradients with single nodes take hundreds of
/// iterations for.
///
/// Each grid has four times the spacing of the next finer one, and a correction is the sum of those of all
/// grids, each found with the blocks of the diagonal that the system has there (Bramble, Pasciak and Xu,
/// "Parallel Multilevel Preconditioners", 1990). The number of iterations hardly depends on that of nodes.
#pragma once
#include <span>
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/implicit_work.hpp"

namespace cut {

/// The grids over a mesh at rest whose nodes these springs join. O(mesh).
[[nodiscard]] std::vector<CoarseGrid> coarse_grids(const HybridMesh& mesh, const SpringArrays& springs);

/// Finds what the grids need to know about the system of this step.
void look_at_system(ImplicitWork& work, const Executor& executor);

/// Leaves in the finest grid's `correction` what all grids together make of `residual`.
void find_correction(ImplicitWork& work, const Executor& executor);

}  // namespace cut
