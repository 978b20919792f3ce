#pragma once

#include <Eigen/Core>

namespace indet {

// Factorisations of symmetric matrices A (n × n) by Eigen, compiled once; only the lower triangle is read.

/// Eigenvalues, ascending. Precondition: n > 0.
Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& A);

/// Orthonormal eigenvectors as columns, in the order of the ascending eigenvalues. Precondition: n > 0.
Eigen::MatrixXd eigenvectors_of(const Eigen::MatrixXd& A);

/// L of A = L Lᵀ, lower triangular. Precondition: A is positive definite.
Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& A);

}  // namespace indet
