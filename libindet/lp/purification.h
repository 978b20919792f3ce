#pragma once

#include <Eigen/Core>

#include "libindet/lp/feasible_set.h"

namespace indet {

/// Purification: from a feasible point to a vertex (Sec. II G of the paper). Move until an inequality becomes
/// active, stay on it, and go on until d independent inequalities are active. Each leg follows the projection
/// of `guide` on the free directions, so that guide·z never decreases as long as it does not vanish; then any
/// free direction. O(K d²) in all.
///
/// This gives the simplex method a feasible start, and turns an optimal point that is not a vertex into one
/// (on an optimal face the projected objective vanishes, so the value stays). Preconditions: x(z) ≥ 0 up to
/// rounding; the set contains no line (slope has rank d).
Basis purify_to_vertex(const SlopeView& view, const Eigen::VectorXd& z, const Eigen::VectorXd& guide);

}  // namespace indet
