#pragma once

#include "libindet/packing/packing.h"

namespace indet::sim {

/// The solvers and simulators here know no images of disks. Throws InputError where the packing is periodic,
/// with what could be done instead; `what` begins the message: "the polish".
void refuse_periodic_cell(const Packing& packing, const char* what);

}  // namespace indet::sim
