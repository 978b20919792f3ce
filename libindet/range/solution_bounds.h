#pragma once

#include <Eigen/Core>

#include "libindet/polytope/force_polytope.h"
#include "libindet/range/basis_system.h"
#include "libindet/range/doubled_equations.h"
#include "libindet/range/unlimited_edges.h"

namespace indet {

/// What is known of the solutions of A x = b and of the polytope F among them, for the exact A and b.
///
/// *Solutions near a point.* Every x has a solution x* with |x*_k − x_k| ≤ reach_k · shift, the shift in
/// proportion to a norm of b − A x. Where the polytope has its analytic centre, its equations tell
/// (barrier/verified_equations.h). Else, with P ≈ A⁺ from a QR factorisation (rows of A independent), γ = ‖A
/// P − 1‖∞ < 1 proves that every right-hand side ρ has a solution A Δ = ρ with ‖Δ‖∞ ≤ ‖P‖∞ ‖ρ‖∞ / (1 − γ), Δ
/// of R and T where both edges of a contact are open.
///
/// *A point inside.* Near `interior` is a solution with x_k ≥ margin_k > 0.
///
/// *Strengths are limited*, x_k ≤ strength_k over F, by the centre, or because Σ x is: with y of the proof
/// that F is bounded, (1 − max (1 − Aᵀ y)_k) Σ x ≤ y · b. Of an unbounded F those are that no ray loads,
/// likewise, with y of the largest sum of these x alone, 0 on the other edges.
class SolutionBounds {
 public:
  /// `everywhere`: of the lightest vertex of every block.
  SolutionBounds(const ForcePolytope& polytope, const DoubledEquations& equations,
                 const LightestSystem& lightest, const BasisSystem& everywhere,
                 const UnlimitedEdges& unlimited);

  /// Of a point with this b − A x; +inf where nothing is proven.
  double shift(const Bounded& residual) const;
  const Eigen::VectorXd& reach() const { return reach_; }

  bool has_interior() const { return has_interior_; }
  const Eigen::VectorXd& interior() const { return interior_; }
  const Eigen::VectorXd& margin() const { return margin_; }
  double interior_shift() const { return interior_shift_; }

  /// Infinite where a ray loads an edge, or nothing is proven.
  const Eigen::VectorXd& strength() const { return strength_; }

 private:
  void take_centre();
  void bound_right_inverse();
  Eigen::VectorXd inexact_entries(const Eigen::VectorXd& weight) const;
  void bound_strengths(const BasisSystem& everywhere);
  void bound_limited_strengths(const LightestSystem& lightest, const UnlimitedEdges& unlimited);

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const DoubledEquations& equations_;
  double gain_ = kInfinity;  ///< ‖P‖∞ / (1 − γ)
  Eigen::VectorXd reach_, interior_, margin_, strength_;
  double interior_shift_ = kInfinity;
  bool has_interior_ = false;
};

}  // namespace indet
