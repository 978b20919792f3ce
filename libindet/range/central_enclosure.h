#pragma once

#include <span>

#include "libindet/polytope/force_polytope.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"

namespace indet {

/// enclose_values where the polytope has a proven analytic centre: the same inequalities, without dense
/// matrices of the size of the problem (barrier/verified_equations.h). The multipliers y of a value are those
/// for which Aᵀ y is nearest to c − h̃, with the reduced costs h̃ ≥ 0 of its basis on the active edges and 0
/// elsewhere, and its state is repaired. Precondition: polytope.central.
Enclosures enclose_by_centre(const ForcePolytope& polytope, const Extrema& extrema,
                             std::span<const SumAtOptimum> sums, const StageProgress& progress);

}  // namespace indet
