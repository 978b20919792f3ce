#pragma once

#include <string>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// Where the scene bounds forces and F is empty: which bounds contradict each other (those in the proof), and
/// the least error at which all are compatible, a sentence each. Nothing where F is not empty, or the bounds
/// are not to blame: no bound is in the proof, or the packing cannot stand without any. Solves for the
/// packing without bounds. Throws LibraryError.
std::vector<std::string> describe_contradiction(const Packing& packing, const ForceRanges& ranges);

}  // namespace indet::app
