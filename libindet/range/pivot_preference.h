#pragma once

#include <span>
#include <vector>

#include "libindet/exact/contact_problem.h"

namespace indet {

/// A preference (one number an edge of the problem) with which ContactProblem::choose_basis takes columns of
/// these edges that are as independent as column pivoting makes them. Any basis would do in rational
/// arithmetic; but what double precision can tell of a solution hangs on its condition, which in regular
/// arrays is large for most. All alike, and so any basis, where the factorisation would take long.
std::vector<double> pivot_preference(const exact::ContactProblem& problem, std::span<const int> edges);

}  // namespace indet
