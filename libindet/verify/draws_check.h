#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Checks contacts that were drawn with unequal probabilities (range/contact_draw.h), and what is estimated
/// from them. The half-planes tell the centre and the widths (centre_check.h), these give the weights and the
/// predictions (rebuilt_predictions.h), the weights and the seed the draws, and draws, values and predictions
/// the estimates. Where means are found by regression, the error of each draw is that of the line through all
/// others.
void check_draws(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                 Comparisons& compare);

}  // namespace indet
