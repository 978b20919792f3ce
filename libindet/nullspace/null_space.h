#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace indet {

/// The solutions of the linear equilibrium problem c u = −w [5] without the contact conditions: u =
/// particular + basis · z.
///
/// Rank decision: sparse QR of cᵀ; where its estimates leave a doubt and the matrix is not too large, a dense
/// singular value decomposition. At φ = 1e-9 the two contacts of the paper's Fig. 2 have a singular value of
/// 1e-9 that must be accepted, while rounding leaves 1e-15 where there should be 0; the gap between the two
/// tells how safe the decision is.
struct NullSpace {
  int rank = 0;
  int nullity = 0;               ///< d = dim ker c [8]
  Eigen::MatrixXd basis;         ///< Z: unknowns × d, orthonormal
  Eigen::VectorXd particular;    ///< F1: the solution of smallest norm, orthogonal to the kernel
  double smallest_accepted = 0;  ///< singular value σ_r (estimate); +inf if rank 0
  double largest_rejected = 0;   ///< bound of σ_{r+1}; 0 if none was rejected
  bool ambiguous = false;        ///< some singular value lies between tolerance::kRankReject and kRankAccept
  Eigen::VectorXd singular_values;    ///< where the dense decomposition was needed; empty otherwise
  std::vector<int> independent_rows;  ///< `rank` rows of c that span its row space
  /// Where −w is not in the range of c: the part of w that no contact force can balance, a left null vector
  /// of c. Empty if balanced.
  Eigen::VectorXd unbalanced;

  double rank_gap() const { return smallest_accepted / largest_rejected; }
};

/// Precondition: wrench.size() = matrix.rows().
NullSpace compute_null_space(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& wrench);

/// v with cᵀ v = q, for q in the row space of c (least squares otherwise): the virtual motion whose relative
/// velocities at the contacts are q.
Eigen::VectorXd motion_from_contacts(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& q);

}  // namespace indet
