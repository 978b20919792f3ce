#pragma once

#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/interval_search.h"
#include "libindet/range/reactions.h"

namespace indet {

/// Bounds from outside of the values of an unbounded F. Reduced costs prove a maximum c·x only as far as Σ
/// h_k x_k is small, h_k > 0 what rounding leaves of them, and no x_k is limited that some ray loads. The
/// barrier method has multipliers whose h_k are exactly 0 there (unbounded_polytope.h): its intervals replace
/// the infinite ends of `enclosures`, of contacts and of `reactions`. An end stays infinite where that proves
/// nothing either. `contacts`: those whose values were found, ascending. Throws Interrupted.
void close_open_ends(const Packing& packing, const std::vector<int>& contacts, const Extrema& extrema,
                     const FoundReactions& reactions, const IntervalOptions& options, Enclosures& enclosures);

}  // namespace indet
