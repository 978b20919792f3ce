#pragma once

#include <vector>

#include "libindet/barrier/verified_equations.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/central_widths.h"
#include "libindet/range/duals.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/interval_search.h"
#include "libindet/range/reactions.h"

namespace indet {

/// The second and third stage of an analysis by the barrier method: intervals of all values that were asked
/// for, without states.
struct BarrierRanges {
  Extrema extrema;        ///< claims kEnclosed, no vertex; or kUnbounded, with a ray
  Enclosures enclosures;  ///< their intervals
  Reactions reactions;    ///< complete
  Duals duals;            ///< of the contacts that were chosen, if the polytope has a centre
};

/// `contacts`: ascending. `widths`: about the centre, of no rows where they are not known yet. A force that
/// is the same in all states by its width (determined_forces.h), or because no edge of its contact is open,
/// needs no search. Where F is empty there are no values. Where it is unbounded, those that grow without
/// limit have a ray, and the others are found in the part of F within a limit; all are kFailed if nothing is
/// proven of it (ForcePolytope::unbounded). Throws Interrupted.
BarrierRanges find_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                  const std::vector<int>& contacts, const CentralWidths& widths,
                                  bool reactions, const IntervalOptions& options,
                                  const DualChoice& duals = {});

/// Bounds of a value in the scene's units, rounded outwards, from those of the least value of the objective
/// sign · value in the problem's.
barrier::ValueBounds value_bounds(const barrier::ValueBounds& least, double sign,
                                  const EquilibriumProblem& problem);

/// What an interval is as a result: its middle is the value; it is enclosed if it is no wider than asked for.
struct EnclosedValue {
  double value = 0;
  Outcome outcome = Outcome::kFailed;
};
/// In the scene's units; `weight`: 1 mg in them.
EnclosedValue enclosed_value(double lower, double upper, double gap, double weight);

}  // namespace indet
