#include "libindet/range/problem_summary.h"

namespace indet {

ProblemSummary summarise(const Packing& packing, const ForcePolytope& polytope) {
  const NullSpace& null_space = *polytope.natural_null_space;
  ProblemSummary summary;
  summary.status = polytope.status;
  summary.unknowns = polytope.natural.unknowns();
  summary.equations = polytope.natural.equations();
  summary.rank = null_space.rank;
  summary.nullity = null_space.nullity;
  summary.dim = polytope.dim;
  const bool is_split = !polytope.blocks.empty() || polytope.dim <= 0;
  summary.blocks = is_split ? static_cast<int>(polytope.blocks.size()) : polytope.parts.count;
  if (summary.blocks < 0) summary.blocks_reason = polytope.parts.reason;
  summary.rank_ambiguous = polytope.rank_ambiguous;
  summary.hairline = polytope.hairline;
  summary.rank_gap = null_space.rank_gap();
  summary.smallest_accepted = null_space.smallest_accepted;
  summary.largest_rejected = null_space.largest_rejected;
  summary.force_unit = packing.force_unit();
  summary.motion = polytope.motion;
  summary.wall_motion = polytope.wall_motion;
  summary.bound_multipliers = polytope.bound_multipliers;
  summary.cell_motion = polytope.cell_motion;
  return summary;
}

}  // namespace indet
