#include "libindet/dense/qr.h"

#include <Eigen/QR>

namespace indet {
namespace {

Eigen::MatrixXd upper_of(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr) {
  return qr.matrixQR().topRows(qr.cols()).triangularView<Eigen::Upper>();
}

}  // namespace

ThinQr factorise_qr(const Eigen::MatrixXd& A) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  return {qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), A.cols()), upper_of(qr)};
}

Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& A) {
  return upper_of(Eigen::HouseholderQR<Eigen::MatrixXd>(A));
}

Eigen::VectorXd solve_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).solve(b);
}

Eigen::VectorXd solve_least_squares_pivoted(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(A).solve(b);
}

Eigen::MatrixXd kernel_basis(const Eigen::MatrixXd& A, double threshold) {
  if (A.cols() == 0) return Eigen::MatrixXd(0, 0);
  if (A.rows() == 0) return Eigen::MatrixXd::Identity(A.cols(), A.cols());
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(threshold);
  qr.compute(A.transpose());
  const Eigen::Index nullity = A.cols() - qr.rank();
  Eigen::MatrixXd last = Eigen::MatrixXd::Zero(A.cols(), nullity);
  last.bottomRows(nullity).setIdentity();
  last.applyOnTheLeft(qr.householderQ());
  return last;
}

std::vector<Eigen::Index> pivot_order(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  const auto& indices = qr.colsPermutation().indices();
  return {indices.begin(), indices.end()};
}

struct MinimumNormSolver::Decomposition {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> of;
};

MinimumNormSolver::MinimumNormSolver(const Eigen::MatrixXd& A)
    : decomposition_(std::make_unique<Decomposition>(
          Decomposition{Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A)})) {}
MinimumNormSolver::~MinimumNormSolver() = default;

Eigen::VectorXd MinimumNormSolver::solve(const Eigen::VectorXd& b) const {
  return decomposition_->of.solve(b);
}

}  // namespace indet
