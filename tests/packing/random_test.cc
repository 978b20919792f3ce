#include "libindet/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace indet {
namespace {

// Reference: SplitMix64 and xoshiro256++ evaluated with Python integers, independent of this code.
TEST(Random, StreamIsTheSameOnEveryMachine) {
  Random random(42);
  const std::vector<std::uint64_t> drawn = {random.bits(), random.bits(), random.bits()};
  EXPECT_EQ(drawn, (std::vector<std::uint64_t>{0xab4c4adfbb450230ULL, 0x16c758048460b512ULL,
                                               0xdeff27396f8eb5c7ULL}));
}

TEST(Random, StreamsOfOneSeedDiffer) { EXPECT_NE(Random(1, 0).bits(), Random(1, 1).bits()); }

TEST(Random, UniformHasTheMomentsOfTheUniformLaw) {
  Random random(7);
  constexpr int kCount = 100000;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.uniform(-1, 3);
    ASSERT_GE(x, -1);
    ASSERT_LT(x, 3);
    sum += x;
    squares += x * x;
  }
  const double sigma = std::sqrt(16.0 / 12 / kCount);
  EXPECT_NEAR(sum / kCount, 1, 4 * sigma);
  EXPECT_NEAR(squares / kCount, 1 + 16.0 / 12, 0.05);
}

TEST(Random, NormalHasUnitVarianceAndTails) {
  Random random(8);
  constexpr int kCount = 100000;
  double squares = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    squares += x * x;
    beyond_two += std::abs(x) > 2 ? 1 : 0;
  }
  EXPECT_NEAR(squares / kCount, 1, 4 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(beyond_two / static_cast<double>(kCount), 0.0455, 0.003);
}

TEST(Random, BelowCoversAllValuesEvenly) {
  Random random(9);
  std::vector<int> count(7);
  for (int i = 0; i < 70000; ++i) ++count[random.below(7)];
  for (const int c : count) EXPECT_NEAR(c, 10000, 400);
}

}  // namespace
}  // namespace indet
