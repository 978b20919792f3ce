#pragma once

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// The motion, or the multipliers of bounds, that prove that no contact forces are admissible: nothing that
/// is held moves, the load does work, and no contact resists. Precondition: ranges.status is kEmpty.
void check_motion(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  Comparisons& compare);

}  // namespace indet
