#pragma once

#include <nlohmann/json_fwd.hpp>

#include "libindet/range/force_ranges.h"

namespace indet::app {

/// A number for JSON, which has no inf and no NaN: "inf", "-inf", null.
nlohmann::json json_number(double value);

/// What ranges are in single numbers and texts, under the names of libindet/range/result_fields.h: the
/// attributes of /equilibrium and /provenance/work, and `requested`.
nlohmann::json summary_to_json(const ForceRanges& ranges);

}  // namespace indet::app
