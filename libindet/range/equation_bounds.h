#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "libindet/polytope/force_polytope.h"

namespace indet {

/// The independent equations A u = b of a polytope with bounds of what rounding can do to them (enclosure.h):
/// of their entries, of b, and of the distance from a point to a solution.
///
/// With P ≈ A⁺ from the QR factorisation, γ = ‖A P − 1‖∞ < 1 proves that every right-hand side ρ has a
/// solution A Δ = ρ with ‖Δ‖∞ ≤ ‖P‖∞ ‖ρ‖∞ / (1 − γ).
class EquationBounds {
 public:
  /// Precondition: the polytope is not empty. `polytope` must outlive this.
  explicit EquationBounds(const ForcePolytope& polytope);

  Eigen::Index rank() const { return matrix_.rows(); }
  /// The independent ones among the equations of the problem.
  const std::vector<int>& rows() const { return rows_; }
  /// A on the edges' strengths: rank × unknowns.
  const Eigen::SparseMatrix<double>& edge_matrix() const { return edge_matrix_; }
  /// P: unknowns × rank.
  const auto& right_inverse() const { return right_inverse_; }
  /// Bound of the rounding of an entry of an independent equation, in units of 8u: entries of stress are
  /// f·l/L, with |f| ≤ √2 and |l|/L ≤ 3/2, each rounded several times.
  double entry_error(Eigen::Index row) const { return is_stress_[static_cast<std::size_t>(row)] ? 3 : 1; }
  /// The rank is that of the polytope, and γ < 1/2.
  bool is_proven() const;

  /// Some exact solution differs from u by at most this in every entry; +inf where nothing is proven.
  double distance_to_solution(const Eigen::VectorXd& u) const;
  /// Upper bound of y·b.
  double load_bound(const Eigen::VectorXd& y) const;

 private:
  void restrict_to_independent_rows();
  void bound_right_inverse();
  /// Adds `weight` of each column whose entries are not stored doubles themselves to the rows that it enters.
  Eigen::VectorXd inexact_entries(const Eigen::VectorXd& weight) const;

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  std::vector<int> rows_;
  Eigen::SparseMatrix<double> matrix_, edge_matrix_;  ///< on these rows
  Eigen::VectorXd load_, load_error_;
  std::vector<bool> is_stress_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> right_inverse_;
  double gain_ = 1;        ///< ‖P‖∞ / (1 − γ); +inf where nothing is proven
  double row_length_ = 0;  ///< most entries of a row of A
};

}  // namespace indet
