#pragma once

#include <Eigen/Core>
#include <array>

namespace indet {

/// R̂ and effective sample sizes computed a second time from their definitions (A. Vehtari, A. Gelman,
/// D. Simpson, B. Carpenter and P.-C. Bürkner, Bayesian Analysis 16, 667 (2021)).
struct ChainDiagnostics {
  /// The larger of R̂ of the values and of their distances from the median. The two values next to the median
  /// are equally far from it but for rounding, so there are three answers: either is nearer, or neither.
  std::array<double, 3> rhat;
  double bulk;  ///< effective sample size of the normal scores
  double tail;  ///< the smaller one of those of x ≤ the 5 % and the 95 % quantile
};

/// `draws`: a column a chain, a row a sample; at least 8 rows, and not all numbers the same.
ChainDiagnostics diagnose_chains(const Eigen::MatrixXd& draws);

/// The effective sample size of the mean of the draws as they are.
double effective_size_of_mean(const Eigen::MatrixXd& draws);

}  // namespace indet
