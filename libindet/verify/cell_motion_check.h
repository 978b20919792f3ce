#pragma once

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"

namespace indet {

/// Checks that the cell of a packing that cannot stand moves only in the ways that do work on the imposed
/// stress. Returns false if its motion has no sense at all: the shape is wrong, or no stress is imposed.
bool check_cell_motion(const Packing& packing, const ForceRanges& ranges, Comparisons& compare);

}  // namespace indet
