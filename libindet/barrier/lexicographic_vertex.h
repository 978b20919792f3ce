#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "libindet/barrier/basis_vertex.h"

namespace indet::barrier {

/// A vertex that is proven by its basis: of all x at which the first functional is least it has the least
/// second one, of these the least third one.
struct LexicographicVertex {
  std::vector<double> x;     ///< one a column, exactly 0 at `closed`
  std::vector<double> y;     ///< multipliers of the first functional
  std::vector<int> closed;   ///< columns outside of the basis, ascending
  double dual_residual = 0;  ///< the largest reduced cost of the wrong sign, of the first functional
  bool is_unique = false;    ///< the first functional is larger at all others: its reduced costs are positive
};

/// How a search ends before its time, and what it costs.
struct VertexSearch {
  std::function<bool()> keep_on;  ///< asked at each step; if it says no there is no vertex
  int& steps;                     ///< those taken are added
};

/// Goes from a basis to the best one by the simplex method with Dantzig's rule: of the first functional, then
/// on its optimal face of the second, and so on; reduced costs up to tolerance::kReducedCost count as 0.
/// `load`: b; `generic_load`: b a little away from where vertices are degenerate. With it each step makes the
/// functional smaller, so that no basis comes twice. What is then infeasible with b itself is mended by the
/// dual simplex method. `functionals`: one weight a column. Nothing if the basis is not feasible or becomes
/// singular, or if it is far away, which takes more steps than tolerance::kMostVertexSteps, or if the first
/// functional is not proven least in the end.
std::optional<LexicographicVertex> find_lexicographic_vertex(BasisVertex& basis,
                                                             std::span<const std::vector<double>> functionals,
                                                             std::span<const double> load,
                                                             std::span<const double> generic_load,
                                                             const VertexSearch& search);

}  // namespace indet::barrier
