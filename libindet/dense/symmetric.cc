#include "libindet/dense/symmetric.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace indet {

Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXd eigenvectors_of(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvectors();
}

Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& A) { return A.llt().matrixL(); }

}  // namespace indet
