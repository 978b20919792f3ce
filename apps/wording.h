#pragma once

#include <cstdint>
#include <string>

#include "libindet/base/counted.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// "9 sliding contacts", from M_s, in which contacts without force count twice, and their number.
std::string describe_sliding(std::int64_t sliding, std::int64_t non_transmitting);

/// "linear programs (edge)", "pivoting-paper (neighbour: first, start: common)", "pivoting-tableau".
std::string describe_method(const ForceRanges& ranges);

}  // namespace indet::app
