#include "libindet/base/doubled_sum.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "libindet/base/random.h"

namespace indet {
namespace {

TEST(DoubledSum, KeepsWhatCancels) {
  DoubledSum sum;
  sum.add(1e16);
  sum.add(1);
  sum.add_product(-1e8, 1e8);
  EXPECT_EQ(sum.value(), 1);
  // (1 + ε)² − 1 − 2ε = ε²
  constexpr double kEpsilon = 0x1p-40;
  DoubledSum square;
  square.add_product(1 + kEpsilon, 1 + kEpsilon);
  square.add(-1);
  square.add(-2 * kEpsilon);
  EXPECT_EQ(square.value(), kEpsilon * kEpsilon);
}

/// A number with some 107 binary digits.
Doubled drawn(Random& random) {
  const double high = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.uniform(-30, 30)));
  return Doubled::of(high, high * 0x1p-54 * random.uniform(-1, 1));
}

mpq_class exact(const Doubled& value) { return mpq_class(value.high) + mpq_class(value.low); }

/// Sums whose leading terms cancel, so that what is left is far smaller than a rounding of them.
TEST(DoubledSum, IsWithinItsErrorOfTheExactSum) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    DoubledSum sum;
    mpq_class expected;
    for (int k = 0; k < 1 + trial / 4; ++k) {
      const Doubled x = drawn(random), y = drawn(random);
      sum.add_product(x, y);
      expected += exact(x) * exact(y);
    }
    const mpq_class leading(-expected.get_d());
    sum.add(leading.get_d());
    expected += leading;
    const mpq_class off = abs(expected - exact(sum.doubled()));
    EXPECT_LE(off, mpq_class(sum.error()));
    EXPECT_GT(std::abs(expected.get_d()), 100 * sum.error()) << "rounding of a double is far larger";
  }
}

TEST(Doubled, ProductsAndSumsKeepAllDigits) {
  Random random(2);
  const mpq_class bound(0x1p-103);
  for (int trial = 0; trial < 200; ++trial) {
    const Doubled x = drawn(random);
    const double y = drawn(random).high;
    const mpq_class product_of = exact(x) * mpq_class(y), sum_of = exact(x) + mpq_class(y);
    EXPECT_LE(mpq_class(abs(exact(product(x, y)) - product_of)), mpq_class(bound * abs(product_of)));
    EXPECT_LE(mpq_class(abs(exact(sum(x, y)) - sum_of)), mpq_class(bound * (abs(exact(x)) + std::abs(y))));
  }
}

}  // namespace
}  // namespace indet
