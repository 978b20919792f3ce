#pragma once

#include <string>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// Where all bodies that contacts hold together are loaded (free disks, loaded walls), nothing takes the sum
/// of their loads: along every direction e that no fixed body takes,
///
///     Σ_disks e·w + Σ_walls e·(load_n n̂ + load_t t̂) = 0
///
/// must hold, and the equations of force say so once more. In rounded numbers they then contradict each other
/// by a rounding, and in exact arithmetic nothing stands. So one load in each such direction, of the last
/// wall that has one, is taken out of the packing: this wall is held instead (not free there), and what it
/// bears follows from the others.
///
/// In a full cell without fixed disks nothing takes loads either, nor is there a wall that could: the loads
/// of the disks of each group must cancel exactly.
///
/// A periodic boundary takes nothing: a group may be joined across it. A fixed disk takes every direction; a
/// wall takes its normal unless load_n is given, and its tangent, unless load_t is, if some contact with it
/// has friction.
///
/// Changes `packing` so. Returns a sentence for each load that was taken out; throws InputError with the sum
/// where loads do not cancel to 1e-9 of their sizes, or in a full cell not exactly. Precondition:
/// find_defect(packing) is empty.
std::vector<std::string> take_out_cancelling_loads(Packing& packing);

}  // namespace indet
