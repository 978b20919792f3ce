#pragma once

#include <nlohmann/json_fwd.hpp>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// What a sample of contacts tells of all. Precondition: a sample was asked for.
nlohmann::json sample_to_json(const ForceRanges& ranges);
void print_sample(const Packing& packing, const ForceRanges& ranges);

}  // namespace indet::app
