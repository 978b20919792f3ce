#include "libindet/statistics/residual_band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/random.h"

namespace indet {
namespace {

TEST(ResidualBand, IsConformalFromNineteenResidualsOn) {
  EXPECT_EQ(fewest_for_conformal(0.95), 19);
  EXPECT_EQ(fewest_for_conformal(0.9), 9);
  EXPECT_EQ(fewest_for_conformal(0.5), 1);
}

TEST(ResidualBand, OfThreeResidualsByHand) {
  // Coverage 3/4: n = 1. Mean 1, deviations −1, −1, 2; mirrored by −(K + 1)/(K − 1) = −2: 2, 2, −4.
  const ResidualBand band = conformal_band(std::vector<double>{0, 0, 3}, 0.75);
  EXPECT_DOUBLE_EQ(band.middle, 1);
  EXPECT_DOUBLE_EQ(band.low, -3);
  EXPECT_DOUBLE_EQ(band.high, 3);
}

/// The definition: of the others, n are at least as far from the mean of all K + 1.
bool holds(const std::vector<double>& residuals, double added, int n) {
  double sum = added;
  for (const double r : residuals) sum += r;
  const double mean = sum / static_cast<double>(residuals.size() + 1);
  return std::count_if(residuals.begin(), residuals.end(),
                       [&](double r) { return std::abs(r - mean) >= std::abs(added - mean); }) >= n;
}

std::vector<double> skewed(Random& random, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::exp(3 * random.uniform()) - 2);
  return values;
}

TEST(ResidualBand, ConformalEndsAreThoseOfTheDefinition) {
  Random random(1);
  for (const auto& [count, n] : {std::pair(19, 1), {20, 1}, {39, 2}, {40, 2}, {100, 5}}) {
    const std::vector<double> residuals = skewed(random, count);
    const ResidualBand band = conformal_band(residuals, 0.95);
    const double step = 1e-9 * (band.high - band.low);
    EXPECT_TRUE(holds(residuals, band.low + step, n));
    EXPECT_FALSE(holds(residuals, band.low - step, n));
    EXPECT_TRUE(holds(residuals, band.high - step, n));
    EXPECT_FALSE(holds(residuals, band.high + step, n));
  }
}

TEST(ResidualBand, ConformalBandsHoldWhateverTheLaw) {
  Random random(2);
  constexpr int kTrials = 20000;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<double> residuals = skewed(random, 21);
    const ResidualBand band = conformal_band(std::span(residuals).first(20), 0.95);
    held += band.low <= residuals.back() && residuals.back() <= band.high ? 1 : 0;
  }
  const double expected = 20.0 / 21;
  EXPECT_NEAR(held / double{kTrials}, expected, 4 * std::sqrt(expected * (1 - expected) / kTrials));
}

TEST(ResidualBand, WithoutResidualsTheLawIsAll) {
  const ResidualLaw law{0.75, -2, 1.6};
  const ResidualBand band = band_by_law({}, law);
  EXPECT_EQ(band.middle, 0);
  EXPECT_DOUBLE_EQ(band.low, -2.5);  // √(1 + 9/16) = 5/4
  EXPECT_DOUBLE_EQ(band.high, 2);
}

TEST(ResidualBand, FewResidualsMoveTheMiddle) {
  // K τ² = 3: three quarters of the mean, and 1 + 0.25 · 1 of the variance.
  const ResidualBand band = band_by_law(std::vector<double>{1, 2, 3}, {1, -1, 1});
  EXPECT_DOUBLE_EQ(band.middle, 1.5);
  EXPECT_DOUBLE_EQ(band.high - band.middle, std::sqrt(1.25));
  // Many leave nothing to guess about what is shared.
  const ResidualBand many = band_by_law(std::vector<double>(100000, 2), {1, -1, 1});
  EXPECT_NEAR(many.middle, 2, 1e-4);
  EXPECT_NEAR(many.low, 1, 1e-4);
}

}  // namespace
}  // namespace indet
