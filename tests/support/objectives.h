#pragma once

#include <vector>

#include "libindet/base/random.h"
#include "libindet/lp/lp_solver.h"
#include "tests/support/oracle.h"

namespace indet::test {

/// A functional with normally distributed weights on about half of the set's inequalities.
Objective random_objective(const SlopeView& view, Random& random);

/// Best value of g·z over the corners that lie on the held faces.
double best_corner(const SlopeView& view, const oracle::Corners& corners, const Objective& objective,
                   const std::vector<int>& held);

/// g·z at the vertex of the answer's basis, which must be feasible.
double value_of(const SlopeView& view, const Objective& objective, const LpAnswer& answer);

}  // namespace indet::test
