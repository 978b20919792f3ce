#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace indet {

/// Rank-revealing sparse QR of a tall or wide matrix, A E = Q R (m × n, rank r), by SuiteSparseQR (T. Davis,
/// ACM Trans. Math. Softw. 38, 8 (2011)). Columns whose norm falls to `tolerance` or below during elimination
/// are dropped: A + δA has rank r exactly with ‖δA‖_F = dropped_norm(), so σ_{r+1}(A) ≤ dropped_norm(). The
/// only file pair that includes SPQR and CHOLMOD.
class SparseQr {
 public:
  /// Throws LibraryError when SPQR fails (out of memory).
  SparseQr(const Eigen::SparseMatrix<double>& matrix, double tolerance);
  ~SparseQr();
  SparseQr(SparseQr&&) noexcept;
  SparseQr& operator=(SparseQr&&) noexcept;

  int rank() const;
  double dropped_norm() const;

  /// Columns of A that are linearly independent and span its range; size rank(), ascending.
  std::vector<int> independent_columns() const;

  /// The last m − r columns of Q: an orthonormal basis of the kernel of Aᵀ, m × (m − r).
  Eigen::MatrixXd left_kernel() const;

  /// The solution of Aᵀ y = b of smallest norm, m; b has size n. If b is not in the range of Aᵀ, only the
  /// independent equations hold.
  Eigen::VectorXd solve_transposed(const Eigen::VectorXd& b) const;

  /// The same for several right-hand sides, the columns of b.
  Eigen::MatrixXd solve_transposed_columns(const Eigen::MatrixXd& b) const;

  /// A least-squares solution of A x = b that is zero outside the independent columns, n; b has size m.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Estimate of the smallest accepted singular value, by inverse iteration on the leading r × r triangle.
  /// From above on that triangle, whose smallest singular value is itself not above σ_r(A). +inf if r = 0.
  double smallest_accepted() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indet
