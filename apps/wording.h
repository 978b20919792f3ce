#pragma once

#include <cstdint>
#include <string>

#include "libindet/base/counted.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// "9 sliding contacts", from M_s, in which contacts without force count twice, and their number.
std::string describe_sliding(std::int64_t sliding, std::int64_t non_transmitting);

/// "12 disks", "12 disks (5 fixed)".
std::string describe_disks(const Packing& packing);

/// "of 40 of 376 contacts given, 0.9876 … 1 of the radius". Precondition: packing.has_levers().
std::string describe_levers(const Packing& packing);

/// "linear programs (edge)", "pivoting-paper (neighbour: first, start: common)", "pivoting-tableau".
std::string describe_method(const ForceRanges& ranges);

}  // namespace indet::app
