#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "libindet/nullspace/sparse_qr.h"

namespace indet {

/// The rank of the equations, as sparse QR of cᵀ decides it. At φ = 1e-9 the two contacts of the paper's Fig.
/// 2 have a singular value of 1e-9 that must be accepted, while rounding leaves 1e-15 where there should be
/// 0; the gap between the two tells how safe the decision is.
struct RankDecision {
  int rank = 0;
  int nullity = 0;               ///< d = dim ker c [8]
  double smallest_accepted = 0;  ///< singular value σ_r (estimate); +inf if rank 0
  double largest_rejected = 0;   ///< bound of σ_{r+1}; 0 if none was rejected
  bool ambiguous = false;        ///< some singular value lies between tolerance::kRankReject and kRankAccept
  std::vector<int> independent_rows;  ///< `rank` rows of c that span its row space

  /// The decomposition of Aᵀ on which all this rests; none if A has no entries.
  std::shared_ptr<const SparseQr> qr;

  double rank_gap() const { return smallest_accepted / largest_rejected; }
};

/// Without a kernel: nothing that is dense is formed.
RankDecision decide_rank(const Eigen::SparseMatrix<double>& matrix);

/// The solutions of the linear equilibrium problem A u = b (c u = −w [5]) without the contact conditions: u =
/// particular + basis · z.
///
/// Rank decision: sparse QR of cᵀ; where its estimates leave a doubt and the matrix is not too large, a dense
/// singular value decomposition.
struct NullSpace : RankDecision {
  Eigen::MatrixXd basis;            ///< Z: unknowns × d, orthonormal
  Eigen::VectorXd particular;       ///< F1: the solution of smallest norm, orthogonal to the kernel
  Eigen::VectorXd singular_values;  ///< where the dense decomposition was needed; empty otherwise
  /// Where b is not in the range of A: the part of −b that no contact force can balance, a left null vector
  /// of A. Empty if balanced.
  Eigen::VectorXd unbalanced;
};

/// Precondition: b.size() = matrix.rows().
NullSpace compute_null_space(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& b);

/// v with Aᵀ v = q, for q in the row space of A (least squares otherwise): the virtual motion whose relative
/// velocities at the contacts are q. `equations`: the rows of A.
Eigen::VectorXd motion_from_contacts(const NullSpace& null_space, int equations, const Eigen::VectorXd& q);

/// P with A_r P = 1 and the smallest columns, A_r the independent rows of A: unknowns × rank.
Eigen::MatrixXd right_inverse(const NullSpace& null_space, const Eigen::SparseMatrix<double>& matrix);

}  // namespace indet
