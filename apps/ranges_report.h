#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// What an analysis found, as indet analyze tells it; `output`: the file that holds all of it.
nlohmann::json report_to_json(const Packing& packing, const ForceRanges& ranges, const std::string& output);
void print_report(const Packing& packing, const ForceRanges& ranges, const std::string& output);

}  // namespace indet::app
