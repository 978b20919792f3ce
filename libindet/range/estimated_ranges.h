#pragma once

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/estimates.h"
#include "libindet/range/force_ranges.h"
#include "libindet/range/interval_search.h"

namespace indet {

/// Ranges of all contacts where hardly any is looked for. Each force is one of
///
///   determined   the same in every state by its width (determined_forces.h): enclosed, δ = 0
///   calibrating  of one of K contacts, drawn without replacement from those that are not determined, each
///                with the same probability: enclosed by the barrier method, options.gap wide
///   kEstimate    δ is predicted, with an interval (predicted_deltas.h); minimum and maximum are not known
///
/// The contacts that are counted as asked for are the calibrating ones. Reactions are not looked for. Throws
/// Interrupted. Precondition: polytope.central.
ForceRanges estimate_ranges(const Packing& packing, const ForcePolytope& polytope,
                            const EstimateOptions& estimate, const IntervalOptions& options);

}  // namespace indet
