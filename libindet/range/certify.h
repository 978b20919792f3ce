#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Reads each value from its stored state, recomputes the primal residuals from the packing, bounds the
/// values where a decision about F is in doubt, and lets the residuals decide between `optimal` and
/// `imprecise`; then counts outcomes. Expects states, vertex, outcome, dual_residual and rank_ambiguous.
void certify(const Packing& packing, ForceRanges& ranges);

}  // namespace indet
