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
/// The exact problem is A u = b, x(u) ≥ 0, with the doubles of the packing taken as they are; A and b in
/// memory differ from it by rounding, which is bounded entry by entry. With P ≈ A⁺ from a QR factorisation
/// (rows of A independent), γ = ‖A P − 1‖∞ < 1 proves that every right-hand side ρ has a solution A Δ = ρ
/// with ‖Δ‖∞ ≤ η = ‖P‖∞ ‖ρ‖∞ / (1 − γ). For max g·u:
///
///   from above, by weak duality, for any y:   g·u ≤ y·b + Σ_k max(0, h_k) X_k,   h = g − Aᵀ y  (on edges)
///
///     where y = Pᵀ (g − h̃) from the reduced costs h̃ = −λ of the basis, and X_k is any bound of x_k over F:
///     from the same inequality for Σx, whose y comes from the proof that F is bounded
///
///   from below, by an admissible state: the stored one plus its Δ violates x ≥ 0 by at most η
///
///     moved by a share θ towards the interior point (plus its own Δ), which keeps a margin from every edge,
///     it violates nothing
///
/// and vice versa for a minimum. Roundings of the evaluation are bounded a priori (Higham, Accuracy and
/// Stability of Numerical Algorithms, ch. 3: |fl(x·y) − x·y| ≤ n u |x|·|y| / (1 − n u)); y·b by Ogita, Rump
/// and Oishi's Dot2.
///
/// Preconditions on which the enclosure rests and that are proven elsewhere: the rank and the closed edges
/// (exact::proves_structure). Where a step fails, that side of the enclosure is infinite. Where F is
/// unbounded there are no X_k: the outer side stays infinite unless every h_k ≤ 0.
///
/// Objectives without an entry in `extrema.proofs` are determined: the same in every state. An empty F has
/// nothing to enclose; `proven` then tells whether its emptiness is beyond doubt.
/// Where the polytope has its analytic centre, it proves the same inequalities without P
/// (central_enclosure.h).
/// `sums`: further functionals, of several contacts at once, to be enclosed likewise. `progress` is told how
/// many values of how many are enclosed; false stops it (Interrupted).
Enclosures enclose_values(const ForcePolytope& polytope, const Extrema& extrema,
                          std::span<const SumAtOptimum> sums = {}, const StageProgress& progress = {});

}  // namespace indet
