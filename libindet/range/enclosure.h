#pragma once

#include <span>
#include <utility>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/lp/feasible_set.h"
#include "libindet/packing/force.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/extrema.h"
#include "libindet/range/outcome.h"
#include "libindet/range/sensitivity.h"

namespace indet {

/// A sum Σ coefficients · (R_1, T_1, …, R_M, T_M) with a state that attains its largest value over F.
struct SumAtOptimum {
  Eigen::VectorXd coefficients;                      ///< 2M, stored doubles
  InternalForces state;                              ///< 2M
  std::vector<std::pair<std::size_t, Basis>> bases;  ///< block and basis that prove it there; blocks in
                                                     ///< which the sum is the same everywhere have none
};

/// Bounds of that largest value, in the scene's units.
struct SumBounds {
  double lower = 0, upper = 0;
};

/// What is known of the values without trust in the search: the third stage of an analysis. Forces are in the
/// scene's units; NaN where there is no extremal state.
struct Enclosures {
  Table4<double> lower, upper;
  Sensitivities sensitivity;
  /// All that the enclosures rest on is proven: nothing about F is in doubt, some admissible state is known,
  /// and a polytope called bounded is. Where not, no enclosure holds.
  bool proven = false;
  std::vector<SumBounds> sums;  ///< of the sums that were asked for
};

/// Rigorous enclosures of the optimal values, and their sensitivity to the geometry.
///
/// The exact problem is A x = b, x ≥ 0, with the doubles of the packing taken as they are, and max g·x:
///
///   from above, by weak duality, for any y:   g·x ≤ y·b + Σ_k max(0, h_k) X_k,   h = g − Aᵀ y
///
///     with y from the basis of the value (basis_system.h) and any bounds X_k of x_k over F
///     (solution_bounds.h). Where rays load edges there are none, and h_k is exactly 0
///     (unlimited_edges.h) or negative there (tilted_multipliers.h)
///
///   from below, by an admissible state: an exact solution is near the x of the basis, and moved by a share θ
///     towards a solution inside, which keeps a margin from every edge, it violates no x ≥ 0
///
/// and vice versa for a minimum. x and y are pairs of doubles, and so are A, b and g (doubled_equations.h):
/// b − A x and what should vanish of h are about 1e-28, so that neither X nor the distance of solutions
/// matters. What is left is the rounding of the ends, the distance of the stored value, and what the basis is
/// short of being optimal or admissible.
///
/// Preconditions on which the enclosure rests and that are proven elsewhere: the rank and the closed edges
/// (exact::proves_structure). Where a step fails, that side of the enclosure is infinite.
///
/// Objectives without an entry in `extrema.proofs` are determined: the same in every state. An empty F has
/// nothing to enclose; `proven` then tells whether its emptiness is beyond doubt.
/// `sums`: further functionals, of several contacts at once, to be enclosed likewise. `progress` is told how
/// many values of how many are enclosed; false stops it (Interrupted). Precondition: polytope.exact, where F
/// is not empty.
Enclosures enclose_values(const ForcePolytope& polytope, const Extrema& extrema,
                          std::span<const SumAtOptimum> sums = {}, const StageProgress& progress = {});

}  // namespace indet
