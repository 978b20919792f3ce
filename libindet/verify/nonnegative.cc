#include "libindet/verify/nonnegative.h"

#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/dense/qr.h"

namespace indet {
namespace {

/// Least squares on the passive columns; zero elsewhere.
Eigen::VectorXd solve_passive(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                              const std::vector<int>& passive) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(A.cols());
  if (!passive.empty()) {
    const Eigen::MatrixXd columns = A(Eigen::all, passive);
    y(passive) = solve_least_squares_pivoted(columns, b);
  }
  return y;
}

}  // namespace

Eigen::VectorXd solve_nonnegative(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const double tolerance = tolerance::kPassiveGradient * (1 + b.norm());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(A.cols());
  std::vector<int> passive;
  for (Eigen::Index step = 0; step < 3 * A.cols(); ++step) {
    Eigen::VectorXd gradient = A.transpose() * (b - A * y);
    for (const int k : passive) gradient[k] = 0;
    Eigen::Index enters = 0;
    if (gradient.size() == 0 || gradient.maxCoeff(&enters) <= tolerance) break;
    passive.push_back(static_cast<int>(enters));
    for (;;) {
      const Eigen::VectorXd trial = solve_passive(A, b, passive);
      double length = 1;
      for (const int k : passive) {
        if (trial[k] <= 0) length = std::min(length, y[k] / (y[k] - trial[k]));
      }
      y += length * (trial - y);
      if (length >= 1) break;
      std::erase_if(passive, [&](int k) { return y[k] <= tolerance::kPassiveZero; });
      for (Eigen::Index k = 0; k < y.size(); ++k) y[k] = y[k] <= tolerance::kPassiveZero ? 0 : y[k];
      if (passive.empty()) break;
    }
  }
  return y;
}

}  // namespace indet
