#pragma once

#include <cstdint>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/limit/limit.h"
#include "libindet/packing/packing.h"

namespace indet {

/// On the way from a packing to a limit F shrinks. Under a load F(λ) = {x ∈ K : A x = b + λ b_1} is the
/// section of one convex set for each λ, so that its ranges, its inscribed radius and its mean width are
/// concave in λ.
struct LimitWalkOptions {
  double effective = 100;  ///< UniformOptions::effective
  std::uint64_t seed = 0;  ///< of every uniform sample
  int threads = 1;         ///< the steps do not depend on it
  ProgressCallback progress;
};

/// F at step_values(). A uniform sample is drawn, and sizes are found, where F is bounded.
/// Preconditions: steps ≥ 1, limit.has_way_to(end). Throws Interrupted, LibraryError.
std::vector<LimitStep> walk_to_limit(const Packing& packing, const Limit& limit, const LimitEnd& end,
                                     int steps, const LimitWalkOptions& options = {});

}  // namespace indet
