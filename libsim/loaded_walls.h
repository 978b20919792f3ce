#pragma once

#include "libindet/packing/packing.h"

namespace indet::sim {

/// The solvers and simulators here know fixed walls alone. Throws InputError where a wall of the packing is
/// loaded, with what could be done instead; `what` begins the message: "the polish".
void refuse_loaded_walls(const Packing& packing, const char* what);

}  // namespace indet::sim
