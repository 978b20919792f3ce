#pragma once

#include <string>

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"

namespace indet {

/// Compares what is said of the states that are kept with what is there: which contacts, and that those of
/// largest δR + δT are these.
void check_kept_states(const ForceRanges& ranges, Comparisons& compare);

/// Checks what can be of a finite value whose state is not in the file, or that none attains: its interval
/// and its residuals. `place` names it.
void check_without_state(const ForceRanges& ranges, int contact, int column, const std::string& place,
                         Comparisons& compare);

}  // namespace indet
