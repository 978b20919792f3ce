#pragma once

#include <optional>

#include "libindet/lp/lp_solver.h"
#include "libindet/packing/packing.h"

namespace indet {

/// By how much each bound of a force (force_bounds.h) has to give way, at least, so that some admissible
/// state keeps to all of them:
///
///     min t ≥ 0   with   A F = b,  F in K,  lo − t ≤ F_k ≤ hi + t   for all bounds
///
/// in the packing's unit of force (mg). 0 if the bounds are compatible. Nothing if the packing cannot stand
/// even without them. It is one linear program, in double precision and not enclosed. Throws LibraryError if
/// that fails.
std::optional<double> least_relaxation(const Packing& packing, const LpOptions& options = {});

}  // namespace indet
