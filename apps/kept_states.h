#pragma once

#include <string>

#include "libindet/range/force_ranges.h"

namespace indet::app {

/// "865 extremal states kept, the canonical ones", and how many values have none; "no extremal states kept;
/// …", with how to get them.
std::string describe_kept_states(const ForceRanges& ranges);

/// Why a file lacks a state, as the end of a sentence, and how to get it: "this file keeps no extremal
/// states; …". Precondition: it does not keep all.
std::string describe_missing_states(const KeptStates& kept);

/// "multipliers and states stored that prove the values of 20 contacts". Precondition: they are kept.
std::string describe_duals(const Duals& duals);

}  // namespace indet::app
