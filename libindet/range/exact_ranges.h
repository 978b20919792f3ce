#pragma once

#include <optional>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

struct ExactOptions {
  double most_work = 0;    ///< limit of exact::Work
  bool reactions = true;   ///< find their ranges, too
  int threads = 1;         ///< the results do not depend on it
  StageProgress progress;  ///< of all objectives and ends of reactions
};

/// The results of an analysis in rational arithmetic, from rank to reactions, with the doubles of the packing
/// taken as they are (docs/decisions/exact-problem.md): nothing in them is in doubt, enclosures are two
/// neighbouring doubles, states are canonical whatever `kept` says, and rounded once. `contacts`, `kept`: as
/// for find_extrema(). `found`: what double precision knows of the equations and the request; and of the
/// states, which are where the search for exact ones begins, if it has any. Nothing if the work is over
/// before all is settled. Throws Interrupted.
std::optional<ForceRanges> find_exact_ranges(const Packing& packing, const std::vector<int>& contacts,
                                             const StateChoice& kept, const ForceRanges& found,
                                             const ExactOptions& options);

}  // namespace indet
