#pragma once

#include <Eigen/Core>

namespace indet {

/// Nonnegative least squares: y ≥ 0 that minimises ‖A y − b‖ (Lawson & Hanson, Solving Least Squares
/// Problems, ch. 23). For matrices of a few hundred columns. Returns the best y found within 3 · columns
/// steps.
Eigen::VectorXd solve_nonnegative(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace indet
