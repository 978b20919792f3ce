#pragma once

#include <vector>

#include "libindet/packing/packing.h"
#include "libsim/simulate.h"

namespace indet::sim {

/// What the contacts of a packing remember of their forces, for a stepper that goes on from it. Contact
/// dynamics: R and T, from which the first sweep starts. Springs: the stretch ξ = −T/k that gives T; R
/// follows from the overlap. `units`: of the world that the packing becomes.
///
/// Throws InputError if some force is not known.
std::vector<ContactState> contact_memory(const Packing& packing, const Units& units,
                                         const SimulationOptions& options);

/// ‖F − F'‖ of two sets of contact forces in units of force (mg); a contact that one of them lacks has none.
double force_distance(const Packing& first, const std::vector<ContactState>& second);

}  // namespace indet::sim
