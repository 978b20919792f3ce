#pragma once

#include "apps/command.h"
#include "libindet/range/analyze.h"

namespace indet::app {

/// Every result again in rational arithmetic (--accuracy exact). Each proof starts from a state, so that all
/// of them are kept on the way, whatever the options choose for the result.
ForceRanges analyze_exactly(const Packing& packing, AnalyzeOptions analysis, const Context& context);

/// Stored ranges as check_exactly() wants them: where not all states are kept, with those of a new search.
/// These are where proofs start, and nothing is taken from them that is not proven.
ForceRanges with_states(const Packing& packing, ForceRanges ranges, const Context& context);

}  // namespace indet::app
