#pragma once

#include <span>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// The analytic centre of {A x = b, x ≥ 0}: the point that maximises Σ log x_k. There is one if and only if
/// the set is bounded and some x > 0 is in it, and then a y with
///
///   A x = b,   (Aᵀ y)_k = 1 / x_k  for each edge k
///
/// (Sonnevend 1985; Boyd and Vandenberghe, Convex Optimization, 8.5.3). It starts every objective: x is
/// strictly feasible, and c + (multiple of Aᵀ y) > 0 for every c. Since Σ_k (Aᵀ y)_k x_k = b·y over the whole
/// set, y also bounds every strength.
struct AnalyticCentre {
  bool found = false;
  std::vector<double> x;  ///< one a column
  std::vector<double> y;  ///< one a row, in the structure's order
  int iterations = 0;
};

/// Newton's method from any start, primal and dual together, with Mehrotra's corrector. Not found where the
/// set is empty, unbounded, without interior, or too thin for double precision.
AnalyticCentre find_analytic_centre(const BlockStructure& structure, BlockCholesky& cholesky);

}  // namespace indet::barrier
