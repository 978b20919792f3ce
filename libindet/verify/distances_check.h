#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Checks smallest distances (SmallestDistances) against what else is in the file: the force itself is part
/// of a distance, so that d ≥ δ − shortage, and no stored pair of extremal states is nearer than the lower
/// bound. In small packings some are found again by nonnegative least squares over the edges' strengths x, x'
///
///   minimise ‖B (x − x')‖² + W² (‖c B x + w‖² + ‖c B x' + w‖² + (R − R_max)² + (R' − R_min)²)
///
/// with a large W.
void check_smallest_distances(const Packing& packing, const ForceRanges& ranges,
                              const RebuiltProblem& problem, Comparisons& compare);

}  // namespace indet
