#include "libindet/statistics/two_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/random.h"
#include "libindet/statistics/convergence.h"

namespace indet {
namespace {

/// A stationary chain of normal values of variance 1 and correlations ρ^lag.
std::vector<double> autoregressive(int length, double rho, std::uint64_t seed) {
  Random random(seed, 0);
  std::vector<double> values;
  double x = random.normal();
  for (int i = 0; i < length; ++i) {
    values.push_back(x);
    x = rho * x + std::sqrt(1 - rho * rho) * random.normal();
  }
  return values;
}

/// p-values of many pairs of chains, the second of which is shifted by `shift` and stretched by `factor`.
struct Probabilities {
  std::vector<double> mean, distribution;
};
Probabilities repeat(int pairs, double rho_a, double rho_b, double shift = 0, double factor = 1) {
  const ChainAssessor of_a(1, 1000);
  const ChainAssessor of_b(1, 500);
  Probabilities p;
  for (int i = 0; i < pairs; ++i) {
    const auto seed = 2 * static_cast<std::uint64_t>(i);
    const std::vector<double> a = autoregressive(1000, rho_a, seed);
    std::vector<double> b = autoregressive(500, rho_b, seed + 1);
    for (double& x : b) x = factor * x + shift;
    const TwoSampleTest test = compare_samples({a, of_a.effective_size(a)}, {b, of_b.effective_size(b)});
    p.mean.push_back(test.p_mean);
    p.distribution.push_back(test.p_distribution);
  }
  return p;
}

double fraction_below(const std::vector<double>& values, double limit) {
  const auto count = std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

/// n_b = 500, 167, 56, 26 effective values.
TEST(CompareSamples, OfEqualCorrelatedChainsGivesUniformProbabilities) {
  constexpr int kPairs = 1000;
  for (const double rho : {0.0, 0.5, 0.8, 0.9}) {
    const Probabilities p = repeat(kPairs, 0.5, rho);
    EXPECT_GT(uniformity_probability(p.mean), 1e-4) << rho;
    for (const double level : {0.01, 0.05, 0.2}) {
      // With 26 effective values the effective size itself is uncertain by a third.
      const double excess = rho > 0.85 ? 0.02 : 0.01;
      const double error = std::sqrt(level * (1 - level) / kPairs);
      EXPECT_NEAR(fraction_below(p.mean, level), level, 3 * error + excess) << rho << ' ' << level;
      EXPECT_LT(fraction_below(p.distribution, level), level + 3 * error) << rho << ' ' << level;
    }
  }
}

/// Were the values taken for independent ones, nearly half of all equal chains would be told apart.
TEST(CompareSamples, WithNumbersOfValuesForEffectiveOnesIsWrong) {
  int rejected = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const std::vector<double> a = autoregressive(1000, 0.5, 2 * i);
    const std::vector<double> b = autoregressive(500, 0.9, 2 * i + 1);
    rejected += compare_samples({a, 1000}, {b, 500}).p_mean < 0.05 ? 1 : 0;
  }
  EXPECT_GT(rejected, 80);
}

TEST(CompareSamples, SeesAShiftByItsMeanAndAStretchByItsDistribution) {
  // n = 333 and 56: the standard error of the difference is 0.145.
  const Probabilities shifted = repeat(300, 0.5, 0.8, 0.6);
  EXPECT_GT(fraction_below(shifted.mean, 0.05), 0.95);
  EXPECT_GT(fraction_below(shifted.distribution, 0.05), 0.8);
  const Probabilities stretched = repeat(300, 0.5, 0.5, 0, 2);
  EXPECT_GT(fraction_below(stretched.distribution, 0.05), 0.95);
  EXPECT_LT(fraction_below(stretched.mean, 0.05), 0.1);
}

/// Two samples of five: t = 2/(0.5 + 0.5)^½ with 8 degrees of freedom.
TEST(CompareSamples, OfFewIndependentValuesIsWelchsTest) {
  const std::vector<double> a = {1, 2, 3, 4, 5};
  const std::vector<double> b = {3, 4, 5, 6, 7};
  const TwoSampleTest test = compare_samples({a, 5}, {b, 5});
  EXPECT_DOUBLE_EQ(test.difference, -2);
  EXPECT_DOUBLE_EQ(test.error, 1);
  // Student's distribution with 8 degrees of freedom: P(|t| > 2) = 0.0805161…, by its closed form
  // 1 − s (1 + c/2 + 3 c²/8 + 5 c³/16), s = t/(t² + 8)^½, c = 8/(t² + 8).
  const double s = 2 / std::sqrt(12.0);
  const double c = 8 / 12.0;
  EXPECT_NEAR(test.p_mean, 1 - s * (1 + c / 2 + 3 * c * c / 8 + 5 * c * c * c / 16), 1e-12);
  EXPECT_DOUBLE_EQ(test.distance, 0.4);
}

TEST(CompareSamples, WithTooFewEffectiveValuesSaysNothing) {
  const std::vector<double> a = {1, 2, 3, 4, 5};
  EXPECT_TRUE(std::isnan(compare_samples({a, 2}, {a, 5}).p_mean));
  EXPECT_TRUE(std::isnan(compare_samples({a, kNaN}, {a, 5}).p_distribution));
}

/// Critical values of the limit: Q(1.3581) = 0.05, Q(1.6276) = 0.01; small n by exact tables: n = 10,
/// D = 0.40925 at 0.05, and n = 20, D = 0.35241 at 0.01.
TEST(KolmogorovProbability, HasItsCriticalValues) {
  EXPECT_NEAR(kolmogorov_probability(1.35810 / 1e4, 1e8), 0.05, 1e-4);
  EXPECT_NEAR(kolmogorov_probability(1.62762 / 1e4, 1e8), 0.01, 1e-4);
  EXPECT_NEAR(kolmogorov_probability(0.40925, 10), 0.05, 1e-3);
  EXPECT_NEAR(kolmogorov_probability(0.35241, 20), 0.01, 1e-3);
  EXPECT_EQ(kolmogorov_probability(0, 10), 1);
}

TEST(UniformityProbability, IsUniformItself) {
  std::vector<double> p;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Random random(i, 3);
    std::vector<double> values(20);
    for (double& x : values) x = random.uniform();
    values.push_back(kNaN);
    p.push_back(uniformity_probability(values));
  }
  for (const double level : {0.05, 0.2, 0.5, 0.8})
    EXPECT_NEAR(fraction_below(p, level), level, 4 * std::sqrt(level * (1 - level) / 500));
  EXPECT_LT(uniformity_probability(std::vector<double>(20, 0.99)), 1e-9);
  EXPECT_TRUE(std::isnan(uniformity_probability(std::vector<double>(3, 0.5))));
}

/// The example of the paper's Sec. 3.2: fifteen p-values, of which four are rejected at the rate 0.05.
TEST(CountDiscoveries, OfTheExampleOfBenjaminiAndHochberg) {
  const std::vector<double> p = {0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                 0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  EXPECT_EQ(count_discoveries(p, 0.05), 4);
  EXPECT_EQ(count_discoveries(std::vector<double>{0.9, kNaN, 0.6}, 0.05), 0);
  EXPECT_EQ(count_discoveries(std::vector<double>{}, 0.05), 0);
  // A large one in between does not protect those below a later limit.
  EXPECT_EQ(count_discoveries(std::vector<double>{0.03, 0.04, 0.045}, 0.05), 3);
}

}  // namespace
}  // namespace indet
