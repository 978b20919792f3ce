#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/statistics/distribution.h"

namespace indet {
namespace {

TEST(Mean, OfFourValuesByHand) {
  const std::vector<double> values = {1, 2, 3, 6, std::nan("")};
  const Estimate mean = mean_of(values);
  EXPECT_DOUBLE_EQ(mean.value, 3);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(mean.error, std::sqrt(14.0 / 12));
}

TEST(Mean, OfOneValueHasNoError) {
  const std::vector<double> values = {4};
  EXPECT_EQ(mean_of(values).value, 4);
  EXPECT_TRUE(std::isnan(mean_of(values).error));
  EXPECT_TRUE(std::isnan(mean_of({}).value));
}

/// The bootstrap error of a mean of independent groups is s_n/√n, s_n² = Σ(x − x̄)²/n.
TEST(Bootstrap, OfAMeanHasItsClosedForm) {
  Random random(3);
  std::vector<double> x(50);
  for (double& value : x) value = random.normal();
  const auto mean = [&](std::span<const double> weights) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += weights[i] * x[i];
    return sum / static_cast<double>(x.size());
  };
  const Estimate estimate = bootstrap(50, mean, {.resamples = 20000, .seed = 5});
  const double expected = standard_deviation(x) * std::sqrt(49.0 / 50) / std::sqrt(50.0);
  EXPECT_NEAR(estimate.error, expected, 0.03 * expected);
  EXPECT_DOUBLE_EQ(estimate.value, mean_of(x).value);
}

TEST(Bootstrap, GroupsThatAreAlikeHaveNoError) {
  GroupedValues data;
  for (int group = 0; group < 5; ++group) {
    for (const double value : {0.5, 1.5, 1.6}) data.add(value, group);
  }
  const Histogram h = histogram(data, 0, 1, 2);
  EXPECT_NEAR(h.density[0], 1.0 / 3, 1e-15);
  EXPECT_NEAR(h.density[1], 2.0 / 3, 1e-15);
  EXPECT_NEAR(h.error[0], 0, 1e-15);
}

TEST(HistogramTest, IntegratesToTheFractionInside) {
  GroupedValues data;
  for (const double value : {-1.0, 0.0, 0.25, 0.5, 2.0, 7.0, HUGE_VAL}) data.add(value, 0);
  const Histogram h = histogram(data, 0, 0.5, 4);
  EXPECT_EQ(h.total, 6);
  EXPECT_EQ(h.outside, 2);
  EXPECT_DOUBLE_EQ(h.density[0], 2.0 / (6 * 0.5));
  EXPECT_DOUBLE_EQ(h.density[1], 1.0 / (6 * 0.5));
  EXPECT_DOUBLE_EQ(h.density[3], 1.0 / (6 * 0.5));  // the upper end belongs to the last bin
}

TEST(HistogramTest, CountsWeighLikeRepeatedValues) {
  GroupedValues repeated, counted;
  for (int i = 0; i < 3; ++i) repeated.add(0.5, 0);
  repeated.add(1.5, 1);
  counted.add(0.5, 0, 3);
  counted.add(1.5, 1, 1);
  EXPECT_EQ(histogram(repeated, 0, 1, 2).density, histogram(counted, 0, 1, 2).density);
  EXPECT_EQ(repeated.total(), counted.total());
  EXPECT_DOUBLE_EQ(kolmogorov_distance(repeated, counted), 0);
}

/// λ = ⟨x − from⟩ with the error λ/√n for independent exponential values.
TEST(Tail, OfAnExponentialDistribution) {
  Random random(7);
  GroupedValues data;
  for (int i = 0; i < 40000; ++i) data.add(-12 * std::log(1 - random.uniform()), i % 400);
  const TailFit fit = fit_tail(data, 20);
  EXPECT_NEAR(fit.decay.value, 12, 4 * 12 / std::sqrt(fit.values));
  EXPECT_NEAR(fit.decay.error, 12 / std::sqrt(fit.values), 0.25 * 12 / std::sqrt(fit.values));
  EXPECT_NEAR(fit.values, 40000 * std::exp(-20.0 / 12), 300);
}

TEST(Tail, WithoutValuesIsNotANumber) {
  GroupedValues data;
  data.add(1, 0);
  data.add(2, 1);
  EXPECT_TRUE(std::isnan(fit_tail(data, 5).decay.value));
}

TEST(Maximum, OfAFallingDensityThereIsNone) {
  GroupedValues data;
  for (int i = 0; i < 4000; ++i) data.add(-20 * std::log((i + 0.5) / 4000), i % 8);
  EXPECT_TRUE(std::isnan(position_of_maximum(data, 5, 60, 5).value));
}

TEST(Quantile, CountsValuesAsOftenAsTheyWereFound) {
  GroupedValues data;
  data.add(3, 0, 97);
  data.add(700, 0, 1);
  data.add(5, 0, 2);
  EXPECT_EQ(quantile(data, 0.97), 3);
  EXPECT_EQ(quantile(data, 0.99), 5);
  EXPECT_EQ(quantile(data, 1), 700);
  EXPECT_TRUE(std::isnan(quantile(GroupedValues{}, 0.5)));
}

TEST(Maximum, OfANormalDistributionIsItsMean) {
  Random random(11);
  GroupedValues data;
  for (int i = 0; i < 60000; ++i) data.add(60 + 15 * random.normal(), i % 60);
  for (int i = 0; i < 20000; ++i) data.add(random.uniform(), i % 60);  // a higher peak below `from`
  const Estimate maximum = position_of_maximum(data, 10, 150, 5);
  EXPECT_NEAR(maximum.value, 60, 2);
  EXPECT_LT(maximum.error, 3);
}

/// 1 twice and 4 once in one group, 2 in the other. Of the four equally likely draws of two groups the means
/// are 2, 2, 2, 2: no error. With 7 in the other: 2, 7, and twice (6 + 7)/4.
TEST(GroupedMean, CountsValuesAndResamplesGroups) {
  GroupedValues data;
  data.add(1, 0, 2);
  data.add(4, 0);
  data.add(2, 1);
  data.add(std::nan(""), 1);
  const Estimate equal = grouped_mean(data);
  EXPECT_DOUBLE_EQ(equal.value, 2);
  EXPECT_NEAR(equal.error, 0, 1e-12);
  data.values[2] = 7;
  const Estimate different = grouped_mean(data, {.resamples = 20000});
  EXPECT_DOUBLE_EQ(different.value, 13.0 / 4);
  const double mean = (2 + 7 + 2 * 3.25) / 4;
  const double variance = (4 + 49 + 2 * 3.25 * 3.25) / 4 - mean * mean;
  EXPECT_NEAR(different.error, std::sqrt(variance), 0.05);
}

TEST(Fraction, CountsTheLowerEndOnly) {
  GroupedValues data;
  for (const double value : {0.0, 1.0, 1.0, 2.0}) data.add(value, 0);
  EXPECT_DOUBLE_EQ(fraction_between(data, 1, 2).value, 0.5);
}

TEST(Kolmogorov, OfShiftedValuesIsTheFractionPassed) {
  GroupedValues a, b;
  for (int i = 0; i < 1000; ++i) {
    a.add(i / 1000.0, 0);
    b.add(i / 1000.0 + 0.0995, 0);
  }
  EXPECT_NEAR(kolmogorov_distance(a, b), 0.1, 1e-12);
}

/// A determined force has no place in its range: NaN among places is no value.
TEST(Kolmogorov, LeavesOutWhatIsNotAValue) {
  GroupedValues a, b;
  for (int i = 0; i < 1000; ++i) {
    a.add(i / 1000.0, 0);
    b.add(i % 10 == 3 ? std::nan("") : i / 1000.0, 0);
  }
  EXPECT_LT(kolmogorov_distance(a, b), 0.002);
  EXPECT_LT(kolmogorov_distance(b, a), 0.002);
}

}  // namespace
}  // namespace indet
