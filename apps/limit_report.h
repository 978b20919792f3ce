#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "libindet/limit/limit.h"

namespace indet::app {

/// What `limit` prints, and `inspect` of its files.
void print_limits(const Packing& packing, const std::vector<Limit>& limits);

/// {"limits": [{"load": "tilt", "unit": "rad", "smallest": …, "smallest_bounds": [lo, hi], …}]}; numbers that
/// are not finite are null.
nlohmann::json limits_to_json(const Packing& packing, const std::vector<Limit>& limits);

}  // namespace indet::app
