#pragma once

#include <memory>
#include <span>
#include <vector>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"
#include "libindet/barrier/lock_step.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// How far a solution with x ≥ 0 is from a point x: within x_c `shift` of it, and then `share` of the way to
/// the one near x_c. Infinite where nothing is proven.
struct NearestSolution {
  double shift = 0, share = 0;
};

/// Bounds of a least value, in the unit of the problem; infinite where nothing is proven.
struct ValueBounds {
  double lower = 0, upper = 0;
};

/// What can be proven about {A x = b, x ≥ 0} from its analytic centre, without trust in any iteration. A and
/// b are those of the scene, of which the ones in memory are roundings with bounds entry by entry.
///
/// *Solutions near a point.* With X = diag(x_c), S a scale of the rows and σ below the smallest singular
/// value of S A X, every residual ρ has a Δ with A Δ = ρ and
///
///   |Δ_k| ≤ x_c,k η,   η = ‖S ρ‖₂ / σ
///
/// σ² is found by one Cholesky factorisation of S A X² Aᵀ S − shift · 1 that runs to its end, less what
/// rounding can have done to it (Rump, BIT 46, 433 (2006)): then A has full rank, too.
///
/// *Strengths are limited.* Where Aᵀ y_c > 0, x_k ≤ X_k = b·y_c / (Aᵀ y_c)_k over the whole set.
///
/// *A least value c·x*, from any x and y of an iteration:
///
///   from below by duality:   c·x ≥ b·y + Σ_k min(0, h_k) X_k,   h = c − Aᵀ y
///   from above by a point of the set: x is repaired (x += X² Aᵀ w, (A X² Aᵀ) w = b − A x), then some
///     exact solution is within x_c η of it, and moved by a share θ towards the one near x_c it violates no x
///     ≥ 0.
///
/// The repair is not optional: in the last steps of an iteration ‖b − A x‖ grows, to 0.1 at times.
///
/// *A limit* (block_structure.h) cuts an unbounded set off so that it has a centre, and no bound rests on
/// it: all hold for the set without it, and its slack may have any value and sign. But nothing
/// is known of the strengths x_k under it, X_k = ∞, so that a bound by duality asks for h_k ≥ 0 there. Along
/// a ray that does not change c·x, Σ_k h_k x_k = 0: every h_k is 0 on its edges, which rounding never leaves
/// it. So y is set to 0, exactly, in all rows that such an edge enters, which makes h_k = c_k there: what a
/// ray presses together does not move. Little is lost of a motion y that is near such a one anyway, as where
/// the equations of the bodies along the rays are independent; else the bound is a poor one, but a bound.
class VerifiedEquations {
 public:
  /// All must outlive this. Precondition: centre.found.
  VerifiedEquations(const EquilibriumProblem& problem, const BlockStructure& structure,
                    const AnalyticCentre& centre);

  /// The rows are independent, some x > 0 is in the set, and it is bounded, but for strengths under a limit.
  bool is_proven() const { return sigma_ > 0 && is_bounded_; }
  /// σ; 0 where nothing is proven.
  double smallest_singular_value() const { return sigma_; }
  /// Some solution is within x_c times this of x_c.
  double centre_shift() const { return centre_shift_; }
  /// X, one a column.
  const std::vector<double>& strength_bounds() const { return strength_; }

  /// x, moved to A x = b but for rounding.
  std::vector<double> repaired(std::span<const double> x) const;
  NearestSolution nearest_solution(std::span<const double> x) const;
  /// η of any x of which these bound |b − A x|, one a row in the structure's order.
  double shift_of_residual(std::span<const double> residual) const;
  /// Bound of the least value from above, by the solution near x.
  double upper_bound(const Objective& objective, std::span<const double> x,
                     const NearestSolution& nearest) const;
  /// Bounds of the least value of the objective. `x`: repaired. They hold whatever x and y are.
  ValueBounds enclose(const Objective& objective, std::span<const double> x, std::span<const double> y) const;
  /// The lower one of these bounds, of any y.
  double lower_bound(const Objective& objective, std::span<const double> y) const;
  /// Multipliers y that make ‖X (c − Aᵀ y)‖₂ least, from one solution: (A X² Aᵀ) y = A X² cᵀ.
  std::vector<double> nearest_multipliers(const Objective& objective) const;
  /// Bounds of c·x over the whole set, which hold whatever y is: duality for c with y − θ y_c and for −c with
  /// −y − θ' y_c, θ and θ' as small as leaves every h_k ≥ 0 (beyond a limit, 0). Where c is a combination of
  /// rows of A, and so c·x the same everywhere, the nearest y leave but rounding between them.
  ValueBounds enclose_everywhere(const Objective& objective, std::span<const double> y) const;

 private:
  void bound_singular_value();
  double factor_rounding() const;
  void bound_strengths();
  /// η of x.
  double shift_of(std::span<const double> x) const;
  double lower_bound_beyond_limit(const Objective& objective, std::vector<double> y, double resting) const;
  /// Sets y to 0 in all rows that the column enters. Returns whether it was not.
  bool stop_motion(std::size_t column, std::vector<double>& y) const;
  /// y_c, with 0 in all rows that a strength under the limit enters.
  std::vector<double> bounding_multipliers() const;
  /// Aᵀ y with bounds of what rounding did to it, and to the entries of A.
  struct Transposed {
    std::vector<double> value, error;
  };
  Transposed verified_transposed_product(std::span<const double> y) const;
  /// Aᵀ y − c in the same way.
  Transposed reduced_costs(const Objective& objective, std::span<const double> y) const;
  /// b·y, and a bound of its distance from the exact one.
  struct LoadProduct {
    double value = 0, error = 0;
  };
  LoadProduct load_product(std::span<const double> y) const;

  const BlockStructure& structure_;
  const AnalyticCentre& centre_;
  double widen_;                     ///< kWiden, and room for sums over all rows or columns
  std::vector<double> squares_;      ///< x_c²
  std::vector<double> scale_;        ///< S
  std::vector<double> entry_error_;  ///< of each row: of an entry of A
  std::vector<double> load_error_;   ///< of b
  std::vector<double> row_terms_;    ///< entries of a row
  std::vector<bool> is_unlimited_;   ///< of each column: the limit alone bounds it, or it is its slack
  std::vector<std::size_t> group_;   ///< of each column
  BlockCholesky cholesky_;           ///< of A X² Aᵀ
  double sigma_ = 0;
  double centre_shift_ = 0;  ///< η of the centre, below 1 where σ > 0
  bool is_bounded_ = false;
  std::vector<double> strength_;
};

}  // namespace indet::barrier
