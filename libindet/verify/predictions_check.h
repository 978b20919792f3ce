#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Checks estimates of δ (range/estimated_ranges.h): centre and widths anew (centre_check.h); from them which
/// forces are determined, and which contacts the seed draws; from these and their ranges each prediction and
/// its interval. The ends of a conformal band are looked for by its definition, by halving. The coefficients
/// of the model are those of the program. Precondition: ranges.calibration ≥ 0.
void check_predictions(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                       Comparisons& compare);

}  // namespace indet
