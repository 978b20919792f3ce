#pragma once

#include "apps/command.h"
#include "libindet/range/analyze.h"

namespace indet::app {

/// Stored ranges as check_exactly() wants them: where not all states are kept, with those of a new search.
/// These are where proofs start, and nothing is taken from them that is not proven.
ForceRanges with_states(const Packing& packing, ForceRanges ranges, const Context& context);

}  // namespace indet::app
