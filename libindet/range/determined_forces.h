#pragma once

#include "libindet/polytope/force_polytope.h"
#include "libindet/range/barrier_ranges.h"
#include "libindet/range/central_widths.h"
#include "libindet/range/interval_search.h"

namespace indet {

/// Whether a width says that its force is the same in every state: it is within rounding of 0, relative to
/// the normal force at the centre.
bool is_determined(const CentralWidths& widths, Eigen::Index contact, bool tangential);

/// Encloses the forces that are determined by their widths: minimum and maximum get one interval, by duality
/// with the nearest multipliers (barrier::VerifiedEquations::enclose_everywhere), and so δ = 0. Where that is
/// wider than tolerance::kDeterminedInterval the width was mistaken, and the outcome is kFailed. Forces of
/// contacts whose edges are all closed are 0. No objective is searched for. `options`: progress alone. Throws
/// Interrupted. Precondition: polytope.central.
void enclose_determined(const ForcePolytope& polytope, const CentralWidths& widths,
                        const IntervalOptions& options, BarrierRanges& ranges);

}  // namespace indet
