#pragma once

#include <string>

#include "libindet/range/force_ranges.h"

namespace indet::app {

/// "865 extremal states kept, the canonical ones"; "no extremal states kept; …", with how to get them.
std::string describe_kept_states(const ForceRanges& ranges);

/// Why a file lacks a state, as the end of a sentence, and how to get it: "this file keeps no extremal
/// states; …". Precondition: it does not keep all.
std::string describe_missing_states(const KeptStates& kept);

}  // namespace indet::app
