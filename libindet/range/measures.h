#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Fills the measures that follow from values, states and simulated forces: δR, δT [23], dR, dT [24], R*, T*
/// [39], norms and the state of largest norm, sliding and non-transmitting contacts of the simulated state.
void compute_measures(const Packing& packing, ForceRanges& ranges);

}  // namespace indet
