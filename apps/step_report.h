#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "libindet/limit/limit.h"

namespace indet::app {

/// A table of F on the way to an end, if anybody went it, and what is left of it there.
void print_steps(const Limit& limit, const LimitEnd& end);

nlohmann::json steps_to_json(const std::vector<LimitStep>& steps);

}  // namespace indet::app
