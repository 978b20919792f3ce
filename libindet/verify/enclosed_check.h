#pragma once

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"

namespace indet {

/// Checks values that are known to an interval (Outcome::kEnclosed), of contacts and of reactions: each is
/// the middle of its interval, which is no wider than asked for. What makes an interval hold is not in the
/// file, but for contacts with duals (duals_check.h). So the ranges of a few contacts, spread evenly, are
/// found again by linear programs, in a packing that is small enough for them (tolerance::kMostForPrograms
/// unknowns), and every interval has to meet the one that is proven there. Throws Interrupted.
void check_enclosed(const Packing& packing, const ForceRanges& ranges, const ProgressCallback& progress,
                    Comparisons& compare);

}  // namespace indet
