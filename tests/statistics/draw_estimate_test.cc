#include "libindet/statistics/draw_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "libindet/base/random.h"

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

}  // namespace
}  // namespace indet
