#pragma once

#include "libindet/limit/tilt.h"

namespace indet {

/// find_tilt_limits where something acts that does not turn with gravity. An end that is not there after a
/// whole turn is kNever. Forces and mechanism are those where the set is left between both bounds.
TiltLimits find_tilt_arc(const Packing& packing, const LimitOptions& options);

}  // namespace indet
