#pragma once

#include <cstdint>

#include "libindet/packing/packing.h"

namespace indet {

/// Equations that the scene needs, counted without the equilibrium problem: forces on a disk that something
/// touches or pulls, and its torque where a contact with friction, or a load, turns it; those of loaded
/// walls, imposed stress and bounds of forces.
std::int64_t needed_equations(const Packing& packing);

}  // namespace indet
