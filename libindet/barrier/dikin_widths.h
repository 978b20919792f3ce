#pragma once

#include <vector>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// How far R and T of each contact reach from the analytic centre within the Dikin ellipsoid, the largest one
/// about it that {A x = b, x ≥ 0} contains (Dikin 1967):
///
///   σ² = c (X² − X² Aᵀ (A X² Aᵀ)⁻¹ A X²) cᵀ,   X = diag(x_c), c the row of R or T
///
/// The interval from minimum to maximum has at least the length 2σ, and is roughly proportional to σ
/// (docs/accuracy.md). One selected inversion of the factor gives all of them (Takahashi et al. 1973; Erisman
/// and Tinney, CACM 18, 177 (1975)).
struct DikinWidths {
  std::vector<double> R, T;  ///< M, in the unit of the problem; 0 where the force is determined
};
/// `cholesky` is used for the factorisation. Precondition: centre.found.
DikinWidths dikin_widths(const EquilibriumProblem& problem, const BlockStructure& structure,
                         const AnalyticCentre& centre, BlockCholesky& cholesky);

}  // namespace indet::barrier
