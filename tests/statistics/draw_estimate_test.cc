#include "libindet/statistics/draw_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/statistics/probability_laws.h"

namespace indet {
namespace {

TEST(DrawEstimate, KnowsTheTextbookNumbers) {
  // z = y / (4 p): 4, 6, 6, 2, 5, 7; t of 5 degrees of freedom at 0.975 is 2.570582.
  const std::vector<DrawnValue> values = {
      {4, 0.25, 1}, {12, 0.5, 2}, {1, 0.125, 1}, {5, 0.25, 1}, {3.5, 0.125, 1}};
  const SampleEstimate estimate = estimate_from_draws(values, 4);
  EXPECT_DOUBLE_EQ(estimate.mean, 5);
  const double s = std::sqrt(16.0 / 5);
  EXPECT_NEAR(estimate.high - 5, 2.5705818356363146 * s / std::sqrt(6.0), 1e-12);
  EXPECT_NEAR(estimate.low + estimate.high, 10, 1e-12);
  EXPECT_DOUBLE_EQ(estimate.band, kBandBias + kBandNoise / std::sqrt(6.0));
}

TEST(DrawEstimate, IsExactWhereTheProbabilityIsProportional) {
  const SampleEstimate estimate = estimate_from_draws({{1, 0.125, 3}, {2, 0.25, 2}, {4, 0.5, 5}}, 5);
  EXPECT_DOUBLE_EQ(estimate.mean, 8.0 / 5);
  EXPECT_DOUBLE_EQ(estimate.low, estimate.high);
}

TEST(DrawEstimate, FewDrawsTellNoInterval) {
  EXPECT_TRUE(std::isnan(estimate_from_draws({{1, 0.5, 5}}, 9).low));
  EXPECT_FALSE(std::isnan(estimate_from_draws({{1, 0.5, 6}}, 9).low));
  EXPECT_FALSE(std::isnan(estimate_from_draws({{1, 0.5, 5}}, 9).mean));
  const SampleEstimate infinite = estimate_from_draws({{std::numeric_limits<double>::infinity(), 0.5, 8}}, 9);
  EXPECT_TRUE(std::isinf(infinite.mean));
  EXPECT_TRUE(std::isnan(infinite.high));
}

/// Widths that spread over decades; values that are proportional to them but for a factor of two either way.
TEST(DrawEstimate, IntervalsCover) {
  Random random(17);
  constexpr std::size_t kCount = 160;
  std::vector<double> values;
  std::vector<double> probability;
  double mean = 0;
  double total = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double width = std::exp(random.normal());
    values.push_back(width * std::exp2(random.uniform(-1, 1)));
    probability.push_back(width + 0.02);
    total += probability.back();
    mean += values.back() / kCount;
  }
  for (double& p : probability) p /= total;
  constexpr int kRepeats = 2000;
  for (const int draws : {6, 10, 20, 40}) {
    int covered = 0;
    double squares = 0;
    for (std::uint64_t seed = 0; seed < kRepeats; ++seed) {
      Random drawing(seed, 1);
      std::vector<DrawnValue> drawn;
      for (int k = 0; k < draws; ++k) {
        double left = drawing.uniform();
        std::size_t i = 0;
        while (i + 1 < kCount && left >= probability[i]) left -= probability[i++];
        drawn.push_back({values[i], probability[i], 1});
      }
      const SampleEstimate estimate = estimate_from_draws(drawn, kCount);
      covered += estimate.low <= mean && mean <= estimate.high ? 1 : 0;
      squares += (estimate.mean - mean) * (estimate.mean - mean);
    }
    EXPECT_GT(covered, 0.92 * kRepeats) << draws;
    EXPECT_LT(covered, 0.98 * kRepeats) << draws;
    // Values vary about their widths by 40 %: the error is that over the root of the number of draws.
    EXPECT_LT(std::sqrt(squares / kRepeats), 0.5 * mean / std::sqrt(draws)) << draws;
  }
}

/// Mean and half-width from the hat matrix H of the regression with a row for each draw, whose coefficients
/// are found by QR: the variance of HC3 is xᵀ X⁺ diag(e_k²/(1 − H_kk)²) X⁺ᵀ x.
std::pair<double, double> by_hat_matrix(const std::vector<DrawnValue>& values, int population,
                                        double mean_prediction) {
  std::vector<DrawnValue> draws;
  for (const DrawnValue& drawn : values)
    draws.insert(draws.end(), static_cast<std::size_t>(drawn.times), drawn);
  const auto count = static_cast<Eigen::Index>(draws.size());
  Eigen::MatrixXd X(count, 2);
  Eigen::VectorXd z(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const DrawnValue& drawn = draws[static_cast<std::size_t>(k)];
    X.row(k) << 1, drawn.prediction / drawn.probability / population;
    z[k] = drawn.value / drawn.probability / population;
  }
  const Eigen::MatrixXd inverse = X.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd hat = X * inverse;
  const Eigen::ArrayXd error = (z - hat * z).array() / (1 - hat.diagonal().array());
  const Eigen::MatrixXd covariance = inverse * error.square().matrix().asDiagonal() * inverse.transpose();
  const Eigen::Vector2d x(1, mean_prediction);
  return {x.dot(inverse * z),
          student_quantile(static_cast<double>(count - 2), 0.975) * std::sqrt(x.dot(covariance * x))};
}

TEST(DrawEstimate, RegressionIsThatOfTheHatMatrix) {
  Random random(3);
  for (int repeat = 0; repeat < 50; ++repeat) {
    std::vector<DrawnValue> values;
    for (int k = 0; k < 4 + repeat % 7; ++k) {
      const double width = std::exp(random.normal());
      values.push_back({width * std::exp2(random.uniform(-1, 1)), 0.01 * width,
                        1 + static_cast<int>(random.below(3)), width * std::exp2(random.uniform(-0.5, 0.5))});
    }
    int draws = 0;
    for (const DrawnValue& drawn : values) draws += drawn.times;
    if (draws < kFewestForRegression) continue;
    const double mean_prediction = std::exp(random.normal());
    const SampleEstimate estimate = estimate_by_regression(values, 80, mean_prediction);
    const auto [mean, reach] = by_hat_matrix(values, 80, mean_prediction);
    EXPECT_NEAR(estimate.mean, mean, 1e-10) << repeat;
    EXPECT_NEAR(estimate.high - estimate.mean, reach, 1e-8 * reach) << repeat;
    EXPECT_NEAR(estimate.mean - estimate.low, reach, 1e-8 * reach) << repeat;
    EXPECT_EQ(estimate.band, estimate_from_draws(values, 80).band);
  }
}

/// z = 2 … 9 at u = 1 … 8 is z = u + 1.
TEST(DrawEstimate, RegressionIsExactOnALine) {
  std::vector<DrawnValue> values;
  for (int k = 1; k <= 8; ++k) values.push_back({k + 1.0, 0.125, 1, static_cast<double>(k)});
  const SampleEstimate estimate = estimate_by_regression(values, 8, 10);
  EXPECT_NEAR(estimate.mean, 11, 1e-12);
  EXPECT_NEAR(estimate.low, 11, 1e-12);
  EXPECT_NEAR(estimate.high, 11, 1e-12);
}

TEST(DrawEstimate, RegressionNeedsMoreThanOneDrawForItsSlope) {
  const auto expect_mean_of_draws = [](const std::vector<DrawnValue>& values) {
    const SampleEstimate estimate = estimate_by_regression(values, 9, 2);
    const SampleEstimate expected = estimate_from_draws(values, 9);
    EXPECT_EQ(estimate.mean, expected.mean);
    EXPECT_TRUE(estimate.high == expected.high || std::isnan(expected.high));
  };
  expect_mean_of_draws({{1, 0.25, 3, 1}, {2, 0.5, 2, 3}, {3, 0.25, 2, 2}});     // few
  expect_mean_of_draws({{1, 0.25, 4, 1}, {2, 0.5, 4, 2}});                      // u is the same
  expect_mean_of_draws({{1, 0.25, 4, 0}, {2, 0.5, 4, 0}});                      // nothing is predicted
  expect_mean_of_draws({{1, 0.25, 4, 1}, {2, 0.5, 4, 2}, {3, 0.125, 1, 1}});    // one draw differs
  expect_mean_of_draws({{1, 0.25, 4, 1}, {2, 0.5, 4, 2.001}, {3, 0.5, 1, 2}});  // hardly any does
  const std::vector<DrawnValue> two_differ = {{1, 0.25, 4, 1}, {2, 0.5, 4, 2}, {3, 0.125, 2, 1}};
  EXPECT_NE(estimate_by_regression(two_differ, 9, 2).mean, estimate_from_draws(two_differ, 9).mean);
}

}  // namespace
}  // namespace indet
