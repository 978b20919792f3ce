#pragma once

#include <limits>
#include <span>

namespace indet {

/// Values of one quantity in a sample whose members may depend on each other, and how many independent ones
/// they are worth (ChainAssessor::effective_size).
struct CorrelatedSample {
  std::span<const double> values;
  double effective = 0;
};

/// Two tests of the hypothesis that two samples a, b come from one distribution. With effective sample sizes
/// n_a, n_b in place of the numbers of values:
///
///   means (B. L. Welch, Biometrika 34, 28 (1947)): t = (ā − b̄)/(s_a²/n_a + s_b²/n_b)^½ has Student's
///     distribution with (s_a²/n_a + s_b²/n_b)²/Σ (s²/n)²/(n − 1) degrees of freedom;
///   distributions (Kolmogorov and Smirnov): D = sup |P_a − P_b|, n = n_a n_b/(n_a + n_b).
///
/// Under the hypothesis p_mean is uniform in [0, 1]. p_distribution is not smaller than that: indicators of
/// x ≤ limit forget faster than x does, so that the effective sizes are cautious for D.
struct TwoSampleTest {
  double difference = std::numeric_limits<double>::quiet_NaN();  ///< ā − b̄
  double error = std::numeric_limits<double>::quiet_NaN();       ///< its standard error
  double p_mean = std::numeric_limits<double>::quiet_NaN();
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< D
  double p_distribution = std::numeric_limits<double>::quiet_NaN();
};

/// NaN where an effective size is not above 2 or one sample has a single value.
TwoSampleTest compare_samples(const CorrelatedSample& a, const CorrelatedSample& b);

/// Probability that the distance of Kolmogorov and Smirnov of n independent values is at least D, by the
/// limit Q(λ) = 2 Σ_k (−1)^{k−1} exp(−2 k² λ²) with Stephens' λ = (√n + 0.12 + 0.11/√n) D, good for n ≥ 4 (M.
/// A. Stephens, J. R. Stat. Soc. B 32, 115 (1970)).
double kolmogorov_probability(double distance, double n);

/// The p-value of the hypothesis that independent values are uniform in [0, 1]. NaN values are left out; NaN
/// for fewer than four.
double uniformity_probability(std::span<const double> values);

/// How many hypotheses are rejected when at most a fraction `rate` of all rejections may be wrong in the mean
/// (Y. Benjamini and Y. Hochberg, J. R. Stat. Soc. B 57, 289 (1995)). NaN values are left out.
int count_discoveries(std::span<const double> p_values, double rate);

}  // namespace indet
