#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace indet {

// Householder QR factorisations by Eigen, compiled once, since each takes seconds of compilation. A is m × n.

/// A = Q R for m ≥ n: Q with n orthonormal columns, R upper triangular (n × n).
struct ThinQr {
  Eigen::MatrixXd Q;
  Eigen::MatrixXd R;
};
ThinQr factorise_qr(const Eigen::MatrixXd& A);

/// R alone.
Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& A);

/// The x that minimises |A x − b|, for A of full column rank.
Eigen::VectorXd solve_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The same with column pivoting; where the rank is deficient, dependent columns get 0.
Eigen::VectorXd solve_least_squares_pivoted(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// An orthonormal basis of ker A, n × (n − rank), from the QR of Aᵀ with column pivoting. Pivots below
/// `threshold` times the largest count as zero.
Eigen::MatrixXd kernel_basis(const Eigen::MatrixXd& A, double threshold);

/// The columns of A in the order in which column pivoting takes them: the first r are the most independent r.
std::vector<Eigen::Index> pivot_order(const Eigen::MatrixXd& A);

/// x of smallest norm among those that minimise |A x − b|, for several b: a complete orthogonal
/// decomposition.
class MinimumNormSolver {
 public:
  explicit MinimumNormSolver(const Eigen::MatrixXd& A);
  ~MinimumNormSolver();
  MinimumNormSolver(const MinimumNormSolver&) = delete;
  MinimumNormSolver& operator=(const MinimumNormSolver&) = delete;

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> decomposition_;
};

}  // namespace indet
