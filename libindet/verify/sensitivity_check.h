#pragma once

#include <string>

#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"

namespace indet {

/// Checks what can be said of a sensitivity without the motions that prove the value: that its claim is one,
/// and that the number can be what is claimed.
void check_sensitivity(const ForceRanges& ranges, int contact, int column, const std::string& place,
                       Comparisons& compare);

}  // namespace indet
