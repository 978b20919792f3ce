#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "libindet/exact/contact_problem.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/exact_tally.h"

namespace indet {

struct ExactCheckOptions;  // exact_check.h

/// The exact answer to both ends of each reaction, as for contacts (exact_check.h). P sums.
struct ExactReactions : ExactTally {
  Table2<Proof> proof;
  Table2<double> value;         ///< rounded to nearest; ±inf; NaN if undecided
  Table2<double> lower, upper;  ///< the exact value between two neighbouring doubles
  Table2<std::int32_t> vertex;  ///< row of `states`, −1: none
  Rows<double> states;          ///< [S, 2M]: exact states that attain the values, rounded to nearest
};

/// Maximises and minimises each sum in rational arithmetic, from the stored state or ray. The coefficients
/// are components of stored normals, levers and 1, all of them taken as they are. `has_solution`: whether
/// there is an admissible state at all; asked where a sum grows without limit. Where the stored rows are not
/// those of the packing, nothing is proven, and that is a contradiction. Precondition: F is not empty.
ExactReactions check_reactions_exactly(const Packing& packing, const ForceRanges& ranges,
                                       const exact::ContactProblem& problem, const ExactCheckOptions& options,
                                       const std::function<bool()>& has_solution);

}  // namespace indet
