#pragma once

#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/barrier_ranges.h"
#include "libindet/range/interval_search.h"
#include "libindet/range/state_choice.h"

namespace indet {

/// Adds the canonical extremal states (docs/decisions/canonical-states.md) of `contacts` (ascending) to
/// ranges that the barrier method has found, and with each state what a vertex proves: the value itself
/// (Outcome::kOptimal), its residuals, its half-planes, a narrower enclosure.
///
/// The optimal face of an objective c is not judged. In its place
///
///   c + δ (g + ε h)   is made least,   g = ΣR, h the generic functional, 0 < ε ≪ 1, 0 < δ ≪ 1,
///
/// by the interior point method: for δ and ε small enough its vertex is the canonical state. Where degenerate
/// vertices would leave the basis open, b is moved a little. The basis that this proposes is priced for c, g
/// and h in turn; where it is not the best one yet, which means that δ was too large, the simplex method goes
/// there from it (barrier/lexicographic_vertex.h). So what is stored is proven, whatever the iteration did;
/// values for which no round of this ends at a proven vertex stay as they are, without a state.
///
/// Precondition: polytope.central. Throws Interrupted.
void add_canonical_states(const Packing& packing, const ForcePolytope& polytope, const StateChoice& kept,
                          const std::vector<int>& contacts, const IntervalOptions& options,
                          BarrierRanges& found);

}  // namespace indet
