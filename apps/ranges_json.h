#pragma once

#include <nlohmann/json_fwd.hpp>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// A number for JSON, which has no inf and no NaN: "inf", "-inf", null.
nlohmann::json json_number(double value);

/// What ranges are in single numbers and texts, under the names of libindet/range/result_fields.h: the
/// attributes of /equilibrium and /provenance/work, and `requested`.
nlohmann::json summary_to_json(const ForceRanges& ranges);

/// A list with an entry for each sum: the body ("wall" or "disk", its id, the wall's name), the component
/// ("R", "T", "x", "y", "torque"), and minimum, maximum, their bounds and outcomes, in the scene's units.
nlohmann::json reactions_to_json(const Packing& packing, const Reactions& reactions);

}  // namespace indet::app
