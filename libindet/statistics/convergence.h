#pragma once

#include <limits>
#include <span>
#include <vector>

namespace indet {

/// How well Markov chains agree about one quantity (A. Vehtari, A. Gelman, D. Simpson, B. Carpenter and
/// P.-C. Bürkner, Bayesian Analysis 16, 667 (2021)). All chains are cut into halves first, so that a drift
/// counts as a disagreement.
struct Convergence {
  /// R̂, the larger of two: of the ranks of the values, turned into normal scores, and of the ranks of the
  /// distances from the median. 1 for chains that agree; NaN for values that are all the same.
  double rhat = std::numeric_limits<double>::quiet_NaN();
  /// Effective sample size for the middle of the distribution (of the normal scores).
  double bulk = std::numeric_limits<double>::quiet_NaN();
  /// Effective sample size for its tails: the smaller of those of I(x ≤ 5 % quantile), I(x ≤ 95 % quantile).
  double tail = std::numeric_limits<double>::quiet_NaN();

  /// R̂ is at most `largest_rhat` and both effective sample sizes are at least `effective`.
  bool reached(double largest_rhat, double effective) const {
    return rhat <= largest_rhat && bulk >= effective && tail >= effective;
  }
};

/// A value and its place before it was put into order.
struct RankedValue {
  double value = 0;
  std::size_t index = 0;
};

/// Assesses quantities of chains that all have the same number and length: what depends on these alone is
/// computed once.
class ChainAssessor {
 public:
  /// Preconditions: chains ≥ 1, length ≥ 8.
  ChainAssessor(int chains, int length);

  /// `values`: one chain after the other, chains · length numbers.
  Convergence assess(std::span<const double> values) const;

  /// The effective sample size of the mean of the values as they are (no ranks): the variance of that mean is
  /// the variance of the values divided by it. NaN for values that are all the same.
  double effective_size(std::span<const double> values) const;

 private:
  std::vector<double> halves(std::span<const double> values) const;
  std::vector<double> normal_scores(const std::vector<RankedValue>& ascending) const;

  int chains_ = 0;
  int length_ = 0;
  int half_ = 0;                ///< length of a half chain
  std::vector<double> scores_;  ///< Φ⁻¹((ρ − 3/8)/(S + 1/4)) for ρ = 1, 3/2, 2, …, S
};

/// The q-quantile of ascending values, interpolated between order statistics (0 and 1 are the ends).
/// Precondition: not empty.
double sorted_quantile(std::span<const double> ascending, double q);

}  // namespace indet
