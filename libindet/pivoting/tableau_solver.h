#pragma once

#include "libindet/lp/lp_solver.h"
#include "libindet/pivoting/pivot_rule.h"
#include "libindet/pivoting/tableau.h"

namespace indet {

/// The paper's walk from extremal point to extremal point (Sec. II G), done on a dense tableau: the
/// directions of the polytope's edges at a vertex follow from those of its neighbour by a change of rank one,
/// instead of being built again. This is the primal simplex method in the coordinates of the null space.
///
/// An objective starts from the vertex that it is given; the tableau goes there from where it is by one block
/// exchange. After kStalled steps without gain it follows Bland's rule until it gains again, so it cannot
/// cycle. Before an optimum is reported the tableau is checked against the slope with a random vector, and
/// factorised anew if rounding has touched it.
///
/// An answer depends on the arguments, and through rounding on the calls before: calls in the same order give
/// the same bytes.
class TableauSolver : public Maximiser {
 public:
  /// `set` must outlive the solver. Of the options the optimality tolerance and the limits are used.
  explicit TableauSolver(const SlopeView& view, PivotRule rule = PivotRule::kSteepestEdge,
                         const LpOptions& options = {});

  LpAnswer maximise(const Objective& objective, const Basis& start, std::span<const int> held = {}) override;

 private:
  LpStatus climb(const Objective& objective, std::int64_t& pivots);
  bool hold(std::span<const int> held, std::int64_t& pivots);
  bool repair();

  PivotRule rule_;
  LpOptions options_;
  Tableau tableau_;
  std::vector<char> is_held_;     ///< d: columns that may not be left
  std::int64_t since_built_ = 0;  ///< exchanges since the last factorisation
};

}  // namespace indet
