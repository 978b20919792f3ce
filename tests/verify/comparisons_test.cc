#include "libindet/verify/comparisons.h"

#include <gtest/gtest.h>

#include <limits>

namespace indet {
namespace {

bool are_equal_probabilities(double stored, double expected) {
  Comparisons compare;
  compare.equal_probability(stored, expected, "p");
  return compare.result().passed();
}

/// The last digits of a tail depend on the machine that computed it: the further out, the more of them.
TEST(Comparisons, ProbabilitiesAgreeAsFarAsTheirExponentsAreKnown) {
  EXPECT_TRUE(are_equal_probabilities(0.3, 0.3 * (1 + 5e-8)));
  EXPECT_TRUE(are_equal_probabilities(1e-120 * (1 + 1e-5), 1e-120));
  EXPECT_TRUE(are_equal_probabilities(1e-300 * (1 + 5e-5), 1e-300));
  EXPECT_TRUE(are_equal_probabilities(3e-310, 2e-310));
  EXPECT_TRUE(are_equal_probabilities(std::numeric_limits<double>::denorm_min(), 0));
  EXPECT_TRUE(are_equal_probabilities(0, std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(are_equal_probabilities(0, 0));
  EXPECT_TRUE(are_equal_probabilities(1, 1));
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(are_equal_probabilities(kNaN, kNaN));
}

TEST(Comparisons, ProbabilitiesThatDifferDiffer) {
  EXPECT_FALSE(are_equal_probabilities(1, 1 - 1e-6));
  EXPECT_FALSE(are_equal_probabilities(0.05 * (1 + 1e-6), 0.05));
  EXPECT_FALSE(are_equal_probabilities(1e-12 * (1 + 1e-5), 1e-12));
  EXPECT_FALSE(are_equal_probabilities(1e-300 * (1 + 1e-3), 1e-300));
  EXPECT_FALSE(are_equal_probabilities(0, 1e-300));
  EXPECT_FALSE(are_equal_probabilities(1e-300, 0));
  EXPECT_FALSE(are_equal_probabilities(std::numeric_limits<double>::quiet_NaN(), 0.5));
  EXPECT_FALSE(are_equal_probabilities(0.5, std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace indet
