#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// Checks the analytic centre and the widths about it (range/central_widths.h). With half-planes of normals
/// n_h within ker c and slacks s_h at the stored centre,
///
///   Σ n_h / s_h = 0,   H = Σ n_h n_hᵀ / s_h²,   σ² of a force = k H⁻¹ kᵀ, k its row of the kernel
///
/// tell whether it is the analytic centre, and the widths. Where an edge is closed in all states the centre
/// has no slack there, and the widths are left unchecked.
void check_centre(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  Comparisons& compare);

}  // namespace indet
