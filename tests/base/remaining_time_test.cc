#include "libindet/base/remaining_time.h"

#include <gtest/gtest.h>

#include <cmath>

namespace indet {
namespace {

TEST(RemainingTime, IsNotKnownBeforeAnythingIsDone) {
  RemainingTime remaining;
  EXPECT_FALSE(remaining.seconds().has_value());
  remaining.update(1, 0);
  EXPECT_FALSE(remaining.seconds().has_value());
}

TEST(RemainingTime, IsExactAtAConstantPace) {
  RemainingTime remaining;
  for (double t = 0.1; t < 60; t += 0.1) {
    remaining.update(t, t / 60);
    EXPECT_NEAR(remaining.seconds().value(), 60 - t, 1e-9);
  }
}

/// A sixth of the work is done in a thirtieth of the time, and the rest takes longer and longer.
TEST(RemainingTime, IsRightWithinAFactorOfTwoWhereTheBeginningIsFasterThanTheEnd) {
  RemainingTime remaining;
  const auto share = [](double t) { return t < 1 ? t / 6 : 1 - 5.0 / 6 * std::pow((30 - t) / 29, 1.3); };
  for (double t = 0.1; t < 28; t += 0.1) {
    remaining.update(t, share(t));
    const double ratio = remaining.seconds().value() / (30 - t);
    if (t < 2) continue;
    EXPECT_GT(ratio, 0.5) << t;
    EXPECT_LT(ratio, 2) << t;
  }
}

TEST(RemainingTime, GoesBackToTheWholeWhereNothingWasDoneOfLate) {
  RemainingTime remaining;
  for (double t = 0.1; t <= 10; t += 0.1) remaining.update(t, 0.5);
  EXPECT_NEAR(remaining.seconds().value(), 10, 0.2);
}

}  // namespace
}  // namespace indet
