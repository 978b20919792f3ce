#include "libindet/statistics/convergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/random.h"

namespace indet {
namespace {

/// x_{i+1} = ρ x_i + (1 − ρ²)^½ ξ: the effective size of its mean is S (1 − ρ)/(1 + ρ).
std::vector<double> autoregressive(int chains, int length, double rho, std::uint64_t seed) {
  std::vector<double> values;
  for (int c = 0; c < chains; ++c) {
    Random random(seed, static_cast<std::uint64_t>(c));
    double x = random.normal();
    for (int i = 0; i < length; ++i) {
      values.push_back(x);
      x = rho * x + std::sqrt(1 - rho * rho) * random.normal();
    }
  }
  return values;
}

TEST(SortedQuantile, InterpolatesBetweenOrderStatistics) {
  const std::vector<double> values = {0, 1, 4};
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0), 0);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0.75), 2.5);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 1), 4);
}

TEST(EffectiveSize, OfAutoregressiveChains) {
  const int chains = 4, length = 20000;
  for (const double rho : {0.0, 0.5, 0.9}) {
    const std::vector<double> values = autoregressive(chains, length, rho, 3);
    const ChainAssessor assessor(chains, length);
    const double expected = chains * length * (1 - rho) / (1 + rho);
    // The error of the estimate grows with the number of correlated lags (about 60 for ρ = 0.9).
    const double tolerance = rho > 0.8 ? 0.2 : 0.1;
    EXPECT_NEAR(assessor.effective_size(values), expected, tolerance * expected) << rho;
    const Convergence c = assessor.assess(values);
    EXPECT_NEAR(c.bulk, expected, tolerance * expected) << rho;
    EXPECT_LT(c.rhat, 1.01) << rho;
    EXPECT_TRUE(c.reached(1.01, 0.8 * std::min(c.bulk, c.tail)));
    // Indicators of tails forget faster than the values do, but not faster than independent ones.
    EXPECT_GT(c.tail, 0.9 * expected) << rho;
    EXPECT_LT(c.tail, 1.1 * chains * length) << rho;
  }
}

/// Anticorrelated values are worth more than independent ones: ρ = −0.5 makes it 3 S.
TEST(EffectiveSize, OfAnticorrelatedChains) {
  const std::vector<double> values = autoregressive(4, 5000, -0.5, 5);
  EXPECT_NEAR(ChainAssessor(4, 5000).effective_size(values), 60000, 6000);
}

TEST(EffectiveSize, IsThatOfTheErrorOfTheMean) {
  const int chains = 2, length = 500, repeats = 300;
  const double rho = 0.8;
  double squares = 0, predicted = 0;
  for (int i = 0; i < repeats; ++i) {
    const auto values = autoregressive(chains, length, rho, 100 + static_cast<std::uint64_t>(i));
    double mean = 0;
    for (const double x : values) mean += x / (chains * length);
    squares += mean * mean / repeats;
    predicted += 1 / ChainAssessor(chains, length).effective_size(values) / repeats;
  }
  // The variance of the mean of 300 squares of normal numbers: relative error (2/300)^½.
  EXPECT_NEAR(squares / predicted, 1, 4 * std::sqrt(2.0 / repeats));
}

TEST(RHat, OfChainsAroundDifferentMeansIsLarge) {
  std::vector<double> values = autoregressive(4, 1000, 0.3, 1);
  const ChainAssessor assessor(4, 1000);
  EXPECT_LT(assessor.assess(values).rhat, 1.01);
  for (int i = 0; i < 1000; ++i) values[static_cast<std::size_t>(i)] += 1;
  EXPECT_GT(assessor.assess(values).rhat, 1.05);
  EXPECT_FALSE(assessor.assess(values).reached(1.01, 10));
  EXPECT_LT(assessor.assess(values).bulk, 100);
}

TEST(RHat, SeesDifferentWidthsByTheFoldedRanks) {
  std::vector<double> values = autoregressive(4, 1000, 0, 2);
  for (int i = 0; i < 1000; ++i) values[static_cast<std::size_t>(i)] *= 3;
  EXPECT_GT(ChainAssessor(4, 1000).assess(values).rhat, 1.05);
}

TEST(RHat, SeesADriftByTheHalvesOfEachChain) {
  std::vector<double> values = autoregressive(4, 1000, 0, 4);
  for (int i = 0; i < 4000; ++i) values[static_cast<std::size_t>(i)] += i % 1000 / 500.0;
  EXPECT_GT(ChainAssessor(4, 1000).assess(values).rhat, 1.05);
}

TEST(RHat, DoesNotChangeWithAMonotoneMap) {
  std::vector<double> values = autoregressive(3, 501, 0.4, 6);
  const ChainAssessor assessor(3, 501);
  const Convergence before = assessor.assess(values);
  for (double& x : values) x = std::exp(3 * x);
  const Convergence after = assessor.assess(values);
  EXPECT_DOUBLE_EQ(after.bulk, before.bulk);
  EXPECT_DOUBLE_EQ(after.tail, before.tail);
}

TEST(Convergence, OfAConstantIsNotANumber) {
  const std::vector<double> values(400, 1.5);
  const Convergence c = ChainAssessor(4, 100).assess(values);
  EXPECT_TRUE(std::isnan(c.rhat));
  EXPECT_TRUE(std::isnan(c.bulk));
  EXPECT_FALSE(c.reached(2, 0));
}

}  // namespace
}  // namespace indet
