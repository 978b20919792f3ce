#pragma once

#include <vector>

#include "libindet/polytope/force_polytope.h"
#include "libindet/range/certify.h"
#include "libindet/range/interval_search.h"
#include "libindet/range/smallest_distances.h"

namespace indet {

/// Distances of these contacts, from the analytic centre (barrier/state_pairs.h). Where F is a point they are
/// 0; empty: kNotRequested; without a centre, because F is unbounded or too thin: kFailed. `certified`: the
/// ranges of the contacts. Results do not depend on options.threads; options.gap does not matter. Throws
/// Interrupted.
SmallestDistances find_smallest_distances(const ForcePolytope& polytope, const Certified& certified,
                                          const std::vector<int>& contacts, const IntervalOptions& options);

}  // namespace indet
