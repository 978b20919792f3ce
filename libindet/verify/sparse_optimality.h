#pragma once

#include <vector>

#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// RebuiltProblem::optimality_gap without the kernel, for packings for which that is too large. Component e
/// of the forces times `sign`, s in the formula, is maximal at a state with these tight half-planes if
///
///   s e = cᵀ y − Σ_h λ_h n_h,   λ ≥ 0,   n_h the gradient of the slack of h
///
/// (Karush, Kuhn and Tucker). Contact by contact that leaves for y the directions in which the force can go
/// both ways; y is their least-squares solution, and the gap the largest entry of what is left, or −λ where
/// that is larger. `tight`: ascending, of each contact two at most that count.
double sparse_optimality_gap(const RebuiltProblem& problem, int component, double sign,
                             const std::vector<int>& tight);

}  // namespace indet
