#pragma once

#include "libindet/base/random.h"
#include "libindet/lp/feasible_set.h"

namespace indet::test {

/// A bounded, full-dimensional set around the origin: a simplex cut by `extra` more half-planes, in both
/// forms. `degenerate`: half-planes with small integers, many of which meet in one vertex or coincide.
SlopeView random_polytope(int d, int extra, bool degenerate, Random& random);

/// Finds the set of which this is a view.
void make_set(SlopeView& view);

}  // namespace indet::test
