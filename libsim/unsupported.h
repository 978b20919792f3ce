#pragma once

#include "libindet/packing/packing.h"

namespace indet::sim {

/// The solvers and simulators here know fixed walls and disks that friction alone limits, in a scene that is
/// not periodic. Throws InputError where the packing has a loaded wall, a periodic cell or a bound of a
/// force, with what could be done instead; `what` begins the message: "the polish".
void refuse_unsupported(const Packing& packing, const char* what);

}  // namespace indet::sim
