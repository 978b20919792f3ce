#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/exact_reactions.h"
#include "libindet/verify/exact_tally.h"

namespace indet {

/// The exact answer to all objectives of a packing.
struct ExactCheck : ExactTally {
  int rank = -1;  ///< of the equations, over the rational numbers
  Table4<Proof> proof;
  Table4<double> lower, upper;  ///< the exact value between two neighbouring doubles; ±inf; NaN if undecided
  /// Of each objective that has one: the exact extremal state, each number rounded to nearest. Row of
  /// `states`, or −1.
  Table4<std::int32_t> vertex;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> states;
  std::vector<std::vector<std::int32_t>>
      zero_edges;                 ///< of each state: half-planes of its basis (nonbasic edges)
  bool proves_emptiness = false;  ///< the packing cannot stand, by an exact certificate
  ExactReactions reactions;       ///< its tally is part of this one
};

struct ExactCheckOptions {
  int threads = 1;        ///< the result does not depend on it
  int pivot_limit = 400;  ///< exact pivots an objective
  ProgressCallback progress;
};

/// Checks stored ranges in rational arithmetic, with the doubles of the packing taken as they are
/// (docs/decisions/exact-problem.md): from the half-planes of each extremal state the exact basic solution,
/// its feasibility, and the optimality of every objective that points to it; from each ray an exact ray; from
/// the motion of a packing that cannot stand an exact Farkas certificate. What is not optimal is repaired by
/// exact pivots. Both ends of each reaction likewise. Throws Interrupted.
ExactCheck check_exactly(const Packing& packing, const ForceRanges& ranges,
                         const ExactCheckOptions& options = {});

/// The ranges with the exact answers in place of the computed ones: values and states rounded to nearest,
/// enclosures of two neighbouring doubles, outcomes, and all measures that follow. What is undecided or
/// refuted becomes imprecise.
ForceRanges adopt_exact(const Packing& packing, const ExactCheck& check, const ForceRanges& ranges);

}  // namespace indet
