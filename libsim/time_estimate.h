#pragma once

#include <cstdint>
#include <string>

#include "libsim/protocol.h"

namespace indet::sim {

/// Roughly the processor time in seconds that a packing of so many disks takes, from the grid to rest in the
/// usual box: contact dynamics, or molecular dynamics with implicit damping (preset paper). Power laws
/// through what was measured on one core of a busy machine, within a factor of two (docs/simulation.md):
///
///   contact dynamics     63 s (N/1600)^1.7      200 … 3200 disks; 2, 6, 23, 63, 177 s with 200, 400, …, 3200
///   molecular dynamics  115 s (N/1600)^1.2      400 … 10 000 disks; 15, 29, 115, 1020 s with 400, 800, 1600,
///   10 000
double seconds_estimate(Simulator simulator, std::int64_t disks);

/// The largest number of disks that the law was measured with.
std::int64_t most_measured(Simulator simulator);

/// What to expect of a simulation that takes more than a minute, in one line; else "". Where molecular
/// dynamics is expected to be clearly faster than contact dynamics, it says so.
std::string time_notice(Simulator simulator, std::int64_t disks);

}  // namespace indet::sim
