#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "libindet/packing/force_bounds.h"

namespace indet {

/// A bound of a force as a row of the equilibrium problem: F − s = lo, F + s = hi, or where a force has both
/// F − s = lo, s + s′ = hi − lo, with slacks s ≥ 0. A slack is a further unknown, and the strength of an edge
/// of its own. Numbers are in the problem's unit.
struct BoundRow {
  ForceBound bound;
  double value = 0;     ///< of the row: lo, hi or hi − lo
  bool closed = false;  ///< the slack is 0 in every state, and no unknown

  /// s + s′ = hi − lo, after the row of the same force's lo.
  bool follows_lower() const { return bound.side == ForceBound::Side::kUpper && bound.is_two_sided(); }
  bool has_slack() const { return !closed && bound.side != ForceBound::Side::kEqual; }
};

/// The unit of the problem: the internal one, unless some bounds of a force are so narrow that tolerances
/// would not tell them apart. Then it is a power of two next to half of the narrowest interval
/// (docs/decisions/narrow-bounds.md).
ForceUnits problem_units(const Packing& packing);

/// A row for each bound. `unit`: of the problem, in the scene's.
std::vector<BoundRow> rows_of(const std::vector<ForceBound>& bounds, double unit);

/// Adds what a force (R, T) of one contact enters of the rows, of which `first_row` is the first, in a
/// column.
void add_to_bounds(const std::vector<BoundRow>& bounds, int first_row, ContactId contact, double R, double T,
                   int column, std::vector<Eigen::Triplet<double>>& out);

/// Adds the column of the slack of bound k.
void add_slack(const std::vector<BoundRow>& bounds, int first_row, int k, int column,
               std::vector<Eigen::Triplet<double>>& out);

}  // namespace indet
