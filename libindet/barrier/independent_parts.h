#pragma once

#include <span>
#include <string>

#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// Into how many independent parts a set falls: sets of forces, those of one part varying independently of
/// those of the others.
struct IndependentParts {
  int count = -1;      ///< −1: not known
  std::string reason;  ///< then
};

/// The independent parts of {A x = b, x ≥ 0}, in groups of columns (block_structure.h). With X = diag(x) of
/// any x > 0 of the set,
///
///   P = 1 − X Aᵀ (A X² Aᵀ)⁻¹ A X
///
/// projects on the directions in which the set extends, in units of x. A group whose rows of P are 0 is the
/// same everywhere, and belongs to no part. P is block diagonal for every division of the other groups into
/// independent sums of parts, and for no other one: with r random on a set S of groups, P r is 0 outside of S
/// if and only if S is a sum of parts (with probability 1). So a part is what one group grows to, when each
/// P r adds the groups where it is not 0. It takes few steps, each some solutions with the factor of A X² Aᵀ,
/// for one reaches as far as double precision tells what forces depend on. Regions, moving groups that are
/// joined by nodes, grow at once. No column of P is formed.
///
/// "0" is up to tolerance::kPartRounding, and what lies between this and tolerance::kPartClear, where nothing
/// else joins it, leaves the count unknown. Preconditions: no limit; the rows of A are independent, as rank
/// and centre of a CentralPolytope prove.
IndependentParts find_independent_parts(const BlockStructure& structure, std::span<const double> x);

}  // namespace indet::barrier
