#pragma once

#include <span>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// A point of the homogeneous self-dual model of "minimise c·x over A x = b, x ≥ 0":
///
///   A x = b τ,   Aᵀ y + s = c τ,   b·y − c·x = κ,   x, s, τ, κ ≥ 0
///
/// (Xu, Hung and Ye, Ann. Oper. Res. 62, 151 (1996)). It has solutions whatever the problem is, and those on
/// the central path lead to one that is strictly complementary (Goldman and Tucker 1956): of each pair x_k,
/// s_k, and of τ, κ, one is 0 and the other is not. With τ > 0, x/τ is a solution and y/τ one of the dual;
/// with κ > 0 there is none, and x or y tells why.
struct SelfDualPoint {
  std::vector<double> x, s;  ///< one a column
  std::vector<double> y;     ///< one a row, in the structure's order
  double tau = 1, kappa = 1;
  /// The smallest ratio of the larger to the smaller of any pair (in the unit of b for x, of c for s): how
  /// clear it is which of them is 0.
  double margin = 1;
  int iterations = 0;
};

/// Follows the central path with Mehrotra's corrector, until the split is clear (tolerance::kClearSplit) and
/// the point accurate, or rounding stops it: then the best point that was seen is returned. `b`: one a row,
/// `c`: one a column, of order one. Precondition: the rows are independent.
SelfDualPoint solve_self_dual(const BlockStructure& structure, BlockCholesky& cholesky,
                              std::span<const double> b, std::span<const double> c);

}  // namespace indet::barrier
