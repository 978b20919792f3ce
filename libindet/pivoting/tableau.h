#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/lp/feasible_set.h"

namespace indet {

/// The dictionary of a FeasibleSet at a vertex. With the d active inequalities N as coordinates, the other
/// K − d (the slack ones, B) read
///
///   x_B = b + D x_N,   D = S_B S_N⁻¹,   b = x_B at the vertex
///
/// Column j of D says how all slacks change along the edge of the polytope on which active inequality j is
/// left. Moving to the neighbouring vertex exchanges one inequality of N for one of B, which changes D by a
/// matrix of rank one: (K − d) d multiplications. D is stored by rows, and rows that the exchange leaves
/// alone are skipped.
///
/// Weights of the columns, γ_j = 1 + ‖D_j‖², are the squared lengths of the edge directions in x; they are
/// kept up to date if asked for.
class Tableau {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `set` must outlive the tableau; slope of rank d ≥ 1. Holds no vertex before build().
  Tableau(const SlopeView& view, bool with_weights);

  bool is_built() const { return !active_.empty(); }

  /// Factorises S_N for the given basis. Returns false if its rows are dependent; the tableau is then not
  /// built.
  bool build(const Basis& basis);

  /// Goes to another vertex by exchanging all inequalities in which the bases differ at once, or by build()
  /// where that is no cheaper. Returns false if the basis is singular.
  bool move_to(const Basis& basis);

  /// Slack row r becomes active in the place of column q. Precondition: D(r, q) ≠ 0.
  void pivot(int r, int q);

  /// ‖D s_N − s_B‖∞ / ‖s‖∞ for s = S u with a fixed u: what rounding has done to D. Costs less than a pivot.
  double error() const;

  /// b anew from D and the offsets (b = o_B − D o_N), which removes what many steps have added up.
  void recompute_slacks();

  /// The gradient of an objective e·x along the edges: eᵀ D, with the coefficients of active inequalities.
  Eigen::VectorXd gradient(const Objective& objective) const;

  Basis basis() const;  ///< ascending

  const std::vector<int>& active() const { return active_; }  ///< d: column → inequality
  const std::vector<int>& slack() const { return slack_; }    ///< K − d: row → inequality
  int row_of(int inequality) const { return position_[static_cast<std::size_t>(inequality)].row; }  ///< or −1
  int column_of(int inequality) const {
    return position_[static_cast<std::size_t>(inequality)].column;
  }                                                            ///< or −1
  const Matrix& rates() const { return rates_; }               ///< D
  const Eigen::VectorXd& slacks() const { return slacks_; }    ///< b
  const Eigen::VectorXd& weights() const { return weights_; }  ///< γ; empty if not asked for

 private:
  struct Position {
    int row = -1, column = -1;
  };

  void exchange(const std::vector<int>& rows, const std::vector<int>& columns);
  void update_positions();
  void recompute_weights();

  const SlopeView& view_;
  bool with_weights_;
  int weight_updates_ = 0;
  Eigen::VectorXd probe_;  ///< s = S u
  std::vector<int> active_, slack_;
  std::vector<Position> position_;  ///< K
  Matrix rates_;
  Eigen::VectorXd slacks_, weights_;
  Eigen::VectorXd column_, row_, product_;  ///< work space of pivot()
};

}  // namespace indet
