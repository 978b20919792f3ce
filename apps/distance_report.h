#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "libindet/range/force_ranges.h"

namespace indet::app {

/// True if smallest distances were asked for (SmallestDistances).
bool has_smallest_distances(const ForceRanges& ranges);

/// "656 smallest distances known to 0.1 %, 2 imprecise, 0 failed", or why there is none. Precondition:
/// has_smallest_distances.
std::string describe_smallest_distances(const ForceRanges& ranges);

/// The numbers of that line, mean and largest distance. The same precondition.
nlohmann::json smallest_distances_to_json(const ForceRanges& ranges);

}  // namespace indet::app
