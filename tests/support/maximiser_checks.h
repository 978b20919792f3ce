#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/lp/maximiser.h"

namespace indet::test {

/// Makes the method that is tested, over a set that outlives it.
using MakeMaximiser = std::function<std::unique_ptr<Maximiser>(const SlopeView&)>;

/// Expects that the method finds the best corner on the faces that it is asked to hold, which contain the
/// start and may be none of its basis, and the best of all corners when asked without them afterwards.
void expect_held_faces_are_kept_and_released(const MakeMaximiser& make, Random& random);

/// Expects that the method, from each of these starts, tells objectives that grow without limit over
/// z0 ≥ 0, z1 ≥ 0, z0 − z1 ≥ −1 (its inequalities 0, 1 and 2) from one that is largest at (0, 1).
void expect_unbounded_is_told_from_optimal(const MakeMaximiser& make, const std::vector<Basis>& starts);

}  // namespace indet::test
