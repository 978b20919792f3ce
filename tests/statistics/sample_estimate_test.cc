#include "libindet/statistics/sample_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "libindet/base/random.h"

namespace indet {
namespace {

TEST(SampleEstimate, KnowsTheTextbookNumbers) {
  // Without skewness Student's: t of 6 degrees of freedom at 0.975 is 2.446912; mean 4, variance 14/3.
  const SampleEstimate estimate = estimate_from_sample({1, 2, 3, 4, 5, 6, 7}, 70);
  EXPECT_EQ(estimate.mean, 4);
  EXPECT_NEAR(estimate.high - 4, 2.4469118511449692 * std::sqrt(14.0 / 3 / 7 * 0.9), 1e-12);
  EXPECT_NEAR(estimate.low + estimate.high, 8, 1e-12);
  EXPECT_NEAR(estimate.band, std::sqrt(std::log(40.0) / 14 * (1 - 6.0 / 70)), 1e-12);
  const SampleEstimate all = estimate_from_sample({1, 2, 3}, 3);
  EXPECT_EQ(all.low, all.high);
  EXPECT_EQ(all.band, 0);
  EXPECT_EQ(estimate_from_sample(std::vector<double>(8, 2.5), 30).high, 2.5);
  EXPECT_TRUE(std::isnan(estimate_from_sample({1}, 3).low));
  EXPECT_TRUE(std::isnan(estimate_from_sample({1, 2, 3, 4, 5}, 50).high));
  const SampleEstimate infinite = estimate_from_sample({1, std::numeric_limits<double>::infinity()}, 3);
  EXPECT_TRUE(std::isinf(infinite.mean));
  EXPECT_TRUE(std::isnan(infinite.low));
}

/// Ends for skewed values solve the cubic equation of Hall's transformation.
TEST(SampleEstimate, ReachesFurtherToTheSideOfTheTail) {
  const std::vector<double> values = {0, 0, 1, 1, 2, 3, 5, 20};
  const SampleEstimate estimate = estimate_from_sample(values, 80);
  EXPECT_EQ(estimate.mean, 4);
  const double s = std::sqrt(312.0 / 7);
  const double skewness = (2 * -64.0 + 2 * -27 - 8 - 1 + 1 + 4096) / 8 / (s * s * s);
  const double quantile = 2.3646242515927853 / std::sqrt(8.0);  // t of 7 degrees of freedom
  for (const auto& [end, target] : {std::pair(estimate.low, quantile), {estimate.high, -quantile}}) {
    const double w = (4 - end) / (s * std::sqrt(0.9));
    const double cubic = w + skewness * w * w / 3 + std::pow(skewness, 2) * std::pow(w, 3) / 27;
    EXPECT_NEAR(cubic + skewness / 48, target, 1e-12);
  }
  EXPECT_GT(estimate.high - 4, 2 * (4 - estimate.low));
}

/// `size` of `count` numbers without replacement.
std::vector<std::size_t> draw(std::uint64_t seed, std::size_t size, std::size_t count) {
  Random random(seed);
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  for (std::size_t i = 0; i < size; ++i) std::swap(numbers[i], numbers[i + random.below(count - i)]);
  numbers.resize(size);
  return numbers;
}

/// Exponential values with an atom at 0, more skewed than δR is: its tail ends.
TEST(SampleEstimate, IntervalsAndBandsCover) {
  Random random(17);
  std::vector<double> values(160);
  double mean = 0;
  for (double& value : values) {
    value = random.uniform() < 0.1 ? 0 : -13 * std::log(1 - random.uniform());
    mean += value / 160;
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  constexpr int kRepeats = 2000;
  for (const std::size_t size : {6, 10, 20, 40, 80}) {
    int intervals = 0;
    int bands = 0;
    for (int seed = 0; seed < kRepeats; ++seed) {
      std::vector<double> drawn;
      for (const std::size_t i : draw(static_cast<std::uint64_t>(seed), size, values.size()))
        drawn.push_back(values[i]);
      const SampleEstimate estimate = estimate_from_sample(drawn, 160);
      intervals += estimate.low <= mean && mean <= estimate.high ? 1 : 0;
      std::sort(drawn.begin(), drawn.end());
      double worst = 0;
      for (const double v : sorted) {
        const auto below = [v](const std::vector<double>& all) {
          return static_cast<double>(std::upper_bound(all.begin(), all.end(), v) - all.begin()) /
                 static_cast<double>(all.size());
        };
        worst = std::max(worst, std::abs(below(drawn) - below(sorted)));
      }
      bands += worst <= estimate.band ? 1 : 0;
    }
    EXPECT_GT(intervals, 0.9 * kRepeats) << size;
    EXPECT_LT(intervals, 0.99 * kRepeats) << size;
    EXPECT_GT(bands, 0.94 * kRepeats) << size;
  }
}

}  // namespace
}  // namespace indet
