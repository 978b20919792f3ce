#pragma once

#include "libindet/base/random.h"
#include "libindet/lp/feasible_set.h"

namespace indet::test {

/// A bounded, full-dimensional set around the origin: a simplex cut by `extra` more half-planes, in both
/// descriptions. `degenerate`: half-planes with small integers, many of which meet in one vertex or coincide.
FeasibleSet random_polytope(int d, int extra, bool degenerate, Random& random);

/// Fills the implicit description from the explicit one.
void describe_implicitly(FeasibleSet& set);

}  // namespace indet::test
