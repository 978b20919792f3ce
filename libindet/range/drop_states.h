#pragma once

#include "libindet/range/force_ranges.h"
#include "libindet/range/state_choice.h"

namespace indet {

/// The same results with the states that `kept` chooses, of those that are there: for what needs all of them
/// on its way. Precondition: the choice has no defect.
ForceRanges drop_states(ForceRanges ranges, const StateChoice& kept);

}  // namespace indet
