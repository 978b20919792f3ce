#pragma once

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/exact_answers.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// The motion, or the multipliers of bounds, that prove that no contact forces are admissible: nothing that
/// is held moves, the load does work, and no contact resists. Where it was found by rational arithmetic and
/// is too close to rounding to prove it as it is stored, that proves it again. Precondition: ranges.status is
/// kEmpty. `exact`: of the same ranges.
void check_motion(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  const ExactAnswers& exact, Comparisons& compare);

}  // namespace indet
