#pragma once

#include <string>

#include "libindet/limit/limit.h"
#include "libindet/verify/comparisons.h"

namespace indet {

/// Checks what is stored of F on the way to an end against itself, and against what it must be as a function
/// of λ. Contact forces of loads add up, so that a range, δ, or the radius of the largest ball in F, is a
/// concave function of the load, and a multiple of the load has that multiple of it:
///
///   d_k = α d_{k−1} + β d_{k+1}, α, β ≥ 0   ⇒   δ(d_k) ≥ α δ(d_{k−1}) + β δ(d_{k+1})
///
/// with d = (1, λ) of a load, and (cos θ, sin θ) of gravity that turns alone. Nothing of F is computed again.
/// `turns_alone`: is_under_gravity_alone, of a tilt.
void check_steps(const Packing& packing, const Limit& limit, const LimitEnd& end, const std::string& name,
                 bool turns_alone, Comparisons& compare);

}  // namespace indet
