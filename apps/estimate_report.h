#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// What was estimated of δ, and on what it rests. Precondition: ranges.calibration ≥ 0.
nlohmann::json estimates_to_json(const ForceRanges& ranges);
void print_estimates(const Packing& packing, const ForceRanges& ranges);

/// "estimated, calibrated on 20 contacts", for a picture.
std::string describe_estimates(const ForceRanges& ranges);

}  // namespace indet::app
