#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Checks what follows from the directions in which F extends: dim, blocks, determined. The directions are
/// those at a mean of the stored states, where these reach the interior of F (affine_hull.h), and else those
/// that open edges leave (free_directions.h). Of the barrier method `determined` counts the forces whose
/// minimum and maximum have one interval.
void check_hull(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                Comparisons& compare);

}  // namespace indet
