#pragma once

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/verification.h"

namespace indet {

/// Checks stored ranges against the packing alone, with code and factorisations of its own (RebuiltProblem):
/// each state (equilibrium, contact conditions, norm, active half-planes), each value and its optimality
/// (Farkas multipliers of the tight half-planes), bounds, residuals, rays, the motion of a packing that
/// cannot stand, dimension, blocks, counts and every measure; `unchecked` names the rest. Objectives that are
/// stored as imprecise or failed are `unsolved`. Throws Interrupted.
Verification verify_ranges(const Packing& packing, const ForceRanges& ranges,
                           const ProgressCallback& progress = {});

}  // namespace indet
