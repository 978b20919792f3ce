#pragma once

#include <span>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"

namespace indet {

/// Solves again, in rational arithmetic from the basis that the search found, each objective with a value
/// that its reduced costs call optimal, and whose enclosure is wider than promised_width(): the two
/// neighbouring doubles of the exact value, widened to hold the stored one, replace it. What is unbounded in
/// exact arithmetic keeps its infinite end. The work is limited in exact solves, weighted by size, so that
/// the same values are settled on every machine. Then, of the sums of `enclosures`, those with an infinite
/// end. Precondition: `enclosures.proven`.
void settle_exactly(const Packing& packing, const ForcePolytope& polytope, const Extrema& extrema,
                    std::span<const SumAtOptimum> sums, Enclosures& enclosures);

}  // namespace indet
