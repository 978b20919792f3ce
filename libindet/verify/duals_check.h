#pragma once

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Proves the stored bounds of values from the multipliers and the states that the file has of them
/// (range/duals.h), with the problem rebuilt from the packing, in double precision. With B = b·ŷ and
/// X_k = B / (Aᵀ ŷ)_k, which needs Aᵀ ŷ > 0 on every edge,
///
///   of a minimum:  lower ≤ b·y + Σ_k min(0, c_k − (Aᵀ y)_k) X_k ≤ upper
///
/// where the sums are right to tolerance::kSumOfProof of their terms; and the state balances the load and
/// keeps to friction to tolerance::kPrimalResidual, and its force is between lower and upper to that. The
/// same of a maximum with the signs reversed. What multipliers prove is true whatever else the file says.
/// Precondition: they are kept.
void check_duals(const ForceRanges& ranges, const RebuiltProblem& problem, Comparisons& compare);

}  // namespace indet
