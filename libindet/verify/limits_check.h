#pragma once

#include <vector>

#include "libindet/limit/limit.h"
#include "libindet/verify/verification.h"

namespace indet {

/// Checks limits from the packing alone: at each end the state balances the load there and respects friction,
/// no contact resists the mechanism, and along it the load does no work there, and some beyond it. Both
/// together prove the value, but for rounding. Rays in the same way. `exact`: it also proves in rational
/// arithmetic that the packing stands at the bound inside and falls at the one outside, each moved by some
/// roundings of the load.
Verification verify_limits(const Packing& packing, const std::vector<Limit>& limits, bool exact);

}  // namespace indet
