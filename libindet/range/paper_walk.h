#pragma once

#include "libindet/lp/feasible_set.h"
#include "libindet/range/objective_table.h"
#include "libindet/range/optimality_checker.h"
#include "libindet/range/paper_options.h"
#include "libindet/range/search_rounds.h"

namespace indet {

/// The values of all wanted objectives as in Sec. II G of the paper: each is walked to by itself
/// (pivoting/neighbour_search.h), from the vertex `start` or, a maximum, from the minimum of the same
/// component (WalkStart), and nothing is learned from other objectives. Throws Interrupted.
void walk_to_values(const SlopeView& view, const OptimalityChecker& checker, const Basis& start,
                    const PaperOptions& options, ObjectiveTable& table, SearchRounds& rounds);

}  // namespace indet
