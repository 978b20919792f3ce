#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// What exact arithmetic says about one objective.
enum class Proof : std::uint8_t {
  kProven,     ///< the stored half-planes (or ray) are those of the exact optimum
  kRepaired,   ///< the exact optimum has other half-planes, found by exact pivots
  kRefuted,    ///< exactly, the outcome is another one: finite against unbounded, or no state at all
  kUndecided,  ///< the limit of pivots was reached
  kNotAsked    ///< not requested
};

/// The exact answer to all objectives of a packing.
struct ExactCheck {
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

  std::int64_t proven = 0, repaired = 0, refuted = 0, undecided = 0;
  std::int64_t pivots = 0;
  std::int64_t contradictions = 0;    ///< certified numbers whose enclosure does not contain the exact value
  double worst_error = 0;             ///< |stored − exact| over all finite values that agree in kind (mg)
  double worst_certified_error = 0;   ///< the same, over those stored as `optimal`
  std::vector<std::string> messages;  ///< the first twenty results that are not proven, or contradicted

  bool passed() const { return refuted == 0 && undecided == 0 && contradictions == 0; }
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
/// exact pivots. Throws Interrupted.
ExactCheck check_exactly(const Packing& packing, const ForceRanges& ranges,
                         const ExactCheckOptions& options = {});

/// The ranges with the exact answers in place of the computed ones: values and states rounded to nearest,
/// enclosures of two neighbouring doubles, outcomes, and all measures that follow. What is undecided or
/// refuted becomes imprecise.
ForceRanges adopt_exact(const Packing& packing, const ExactCheck& check, const ForceRanges& ranges);

}  // namespace indet
