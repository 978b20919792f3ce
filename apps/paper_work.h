#pragma once

#include <nlohmann/json.hpp>

#include "libindet/range/force_ranges.h"

namespace indet::app {

/// How the paper's method was done, what it did, and its failures by their kind.
nlohmann::json describe_paper_work(const ForceRanges& ranges);
void print_paper_work(const PaperWork& work);

}  // namespace indet::app
