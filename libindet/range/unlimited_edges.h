#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/exact/edge_span.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/doubled_equations.h"

namespace indet {

/// The edges U of an unbounded F that rays load. Weak duality,
///
///   g·x ≤ y·b + Σ_k h_k x_k,   h = g − Aᵀ y,
///
/// bounds g only with h_k ≤ 0 there; and since h·r = g·r = 0 along the rays of a g that is bounded, only with
/// h_k = 0 exactly. Near multipliers that rounding has left with h_k ≈ 0 are exact ones. With as many rows J
/// as columns C ⊂ U, A_JC regular, and every other column of U a combination of these, a_k = Σ_c β_kc a_c, in
/// rational arithmetic,
///
///   y* = y + δ,   δ = 0 outside of J,   A_JCᵀ δ = h_C,   |δ_j| ≤ ‖A_JC⁻ᵀ‖∞ ‖h_C‖∞
///
/// has h*_k = 0 on C; and on all of U if g is *level* there, g_k = Σ_c β_kc g_c. (A, δ and h_C here with the
/// scales of the exact problem.)
class UnlimitedEdges {
 public:
  /// Precondition: the polytope has its exact problem and is not empty. Numbers of edges are those of its
  /// problem.
  explicit UnlimitedEdges(const ForcePolytope& polytope);

  bool contains(int edge) const { return contains_[static_cast<std::size_t>(edge)]; }
  bool any() const { return norm_ > 0; }

  /// Whether Σ coefficient · force, of R_α (component 2α) and T_α (2α + 1), is level; without U, everything
  /// is.
  bool is_level(std::span<const std::pair<int, double>> on_forces) const;

  /// A bound of |δ_j| for what is left of h; infinite if nothing is proven, 0 without U. Precondition: g is
  /// level.
  double shift(const Bounded& residual) const;
  /// By how much at most a shift of 1 changes h_k and y·b.
  const Eigen::VectorXd& reach() const { return reach_; }
  double load_reach() const { return load_reach_; }

 private:
  bool find_combinations(const std::vector<int>& edges);
  void bound_reach(const ForcePolytope& polytope);

  const exact::ContactProblem& exact_;
  std::vector<bool> contains_;
  std::optional<exact::EdgeSpan> span_;          ///< of U
  std::vector<std::pair<int, double>> columns_;  ///< C, with what exact strengths are divided by
  /// Of other edges of U, by their numbers in the exact problem: β times a scale.
  std::vector<std::pair<int, exact::EdgeSpan::Combination>> combinations_;
  double norm_ = 0;  ///< bound of ‖A_JC⁻ᵀ‖∞; infinite if nothing is proven, 0 without U
  Eigen::VectorXd reach_;
  double load_reach_ = 0;
};

}  // namespace indet
