#pragma once

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/exact_answers.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Compares what is stored of reactions with the packing: which sums there are, the states that attain them
/// (balance, contact conditions, value, optimality as for single forces), that no other stored state is
/// outside, and that a loaded wall bears its load.
/// `exact`: of the same ranges.
void check_reactions(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                     const ExactAnswers& exact, Comparisons& compare);

}  // namespace indet
