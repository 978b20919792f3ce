#pragma once

#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/interval_search.h"
#include "libindet/range/reactions.h"

namespace indet {

/// Bounds from outside of the values of an unbounded F. Multipliers of a basis prove a maximum c·x where it
/// stays as it is along all rays (unlimited_edges.h), or falls along all (tilted_multipliers.h); where rays
/// differ, often not. The barrier method has multipliers whose h_k are exactly 0 on unlimited edges
/// (unbounded_polytope.h): its intervals replace the infinite ends of `enclosures`, of contacts and of
/// `reactions`. An end stays infinite where that proves nothing either. `contacts`: those whose values were
/// found, ascending. Throws Interrupted.
void close_open_ends(const Packing& packing, const std::vector<int>& contacts, const Extrema& extrema,
                     const FoundReactions& reactions, const IntervalOptions& options, Enclosures& enclosures);

}  // namespace indet
