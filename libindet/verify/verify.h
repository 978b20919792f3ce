#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// What the check of a file's results found.
struct Verification {
  std::int64_t checks = 0;          ///< comparisons made
  std::int64_t contradictions = 0;  ///< comparisons that failed
  std::vector<std::string>
      messages;  ///< the first twenty contradictions, each with place, stored and recomputed number
  double worst_imbalance = 0;       ///< ‖cF + w‖∞ over all states (mg)
  double worst_violation = 0;       ///< of the contact conditions, over all states (mg)
  double worst_optimality_gap = 0;  ///< over all finite objectives; dimensionless

  bool passed() const { return contradictions == 0; }
};

/// Checks every stored result against the packing alone, with code and factorisations of its own (class
/// Oracle): each state (equilibrium, contact conditions, norm, active half-planes), each value and its
/// optimality (Farkas multipliers of the tight half-planes), bounds, residuals, rays, the motion of a packing
/// that cannot stand, counts, dimension and every measure. Throws Interrupted.
Verification verify_ranges(const Packing& packing, const ForceRanges& ranges,
                           const ProgressCallback& progress = {});

}  // namespace indet
