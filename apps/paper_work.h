#pragma once

#include <nlohmann/json.hpp>

#include "libindet/range/paper_work.h"

namespace indet::app {

/// What the paper's method did, and its failures by their kind.
nlohmann::json describe_paper_work(const PaperWork& work);
void print_paper_work(const PaperWork& work);

}  // namespace indet::app
