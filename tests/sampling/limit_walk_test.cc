#include "libindet/sampling/limit_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "libindet/base/error.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

constexpr int kSteps = 3;
constexpr double kPhi = 0.6, kMu = 0.4;
constexpr double kError = 1e-10;  // mg

/// A disk in a groove: F is a segment, whose ranges are these times `share`.
void expect_segment(const LimitStep& step, const zoo::WedgeRanges& ranges, double share) {
  const double delta_R = share * ranges.delta_R;
  const double delta_T = share * ranges.delta_T;
  const double length = std::sqrt(2 * (delta_R * delta_R + delta_T * delta_T));
  EXPECT_EQ(step.dim, 1);
  EXPECT_TRUE(step.is_certain());
  EXPECT_NEAR(step.mean_delta_R, delta_R, kError);
  EXPECT_NEAR(step.largest_delta_R, delta_R, kError);
  EXPECT_NEAR(step.mean_delta_T, delta_T, kError);
  EXPECT_NEAR(step.largest_delta_T, delta_T, kError);
  EXPECT_NEAR(step.inscribed_radius, length / 2, kError);
  EXPECT_NEAR(step.mean_width, length, kError);
  EXPECT_NEAR(step.mean_width_error, 0, kError);
  EXPECT_GT(step.r_error, 0);
  EXPECT_NEAR(step.r, length / std::sqrt(12.0), 4 * step.r_error);
  EXPECT_LT(step.r_error, 0.1 * step.r);
}

TEST(LimitWalk, OfATiltedGrooveEndsInAPoint) {
  const Packing packing = zoo::wedge(kPhi, kMu);
  const Limit limit = find_tilt(packing);
  for (const LimitEnd* end : {&limit.smallest, &limit.largest}) {
    ASSERT_TRUE(limit.has_way_to(*end));
    EXPECT_EQ(end->dim, 0);
    const std::vector<LimitStep> steps = walk_to_limit(packing, limit, *end, kSteps);
    ASSERT_EQ(steps.size(), kSteps + 1U);
    for (int k = 0; k <= kSteps; ++k) {
      const double share = k < kSteps ? k / double{kSteps} : 1 - kStepBeforeLimit;
      const LimitStep& step = steps[static_cast<std::size_t>(k)];
      EXPECT_NEAR(step.value, share * end->value, 1e-15);
      // |T| ≤ μ min(R_0, R_1), of which R_1 − R_0 = sin θ/sin φ.
      expect_segment(step, zoo::wedge_ranges(kPhi, kMu), std::sin((1 - share) * kPhi) / std::sin(kPhi));
      // Just before the limit one contact has next to no force, but not as little as ε.
      EXPECT_LE(step.sliding, 0.1);
    }
  }
}

TEST(LimitWalk, OfALoadIsInMgOfThePackingAsItIs) {
  // The weight changes, so that F is a multiple of what it is; where nothing weighs, it is a point.
  const Packing packing = zoo::wedge(kPhi, kMu);
  Loads gravity;
  gravity.gravity = {0, 0.5};
  const Limit limit = find_load(packing, "gravity", gravity);
  EXPECT_EQ(limit.smallest.outcome, LimitOutcome::kNever);
  EXPECT_FALSE(limit.has_way_to(limit.smallest));
  EXPECT_NEAR(limit.largest.value, 2, 1e-15);
  const std::vector<LimitStep> steps = walk_to_limit(packing, limit, limit.largest, kSteps);
  for (const LimitStep& step : steps) expect_segment(step, zoo::wedge_ranges(kPhi, kMu), 1 - step.value / 2);
  EXPECT_EQ(steps.front().value, 0);
  EXPECT_NEAR(steps.back().value, 2, 1e-3);
}

TEST(LimitWalk, OfFrictionEndsInAPoint) {
  const Packing packing = zoo::wedge(kPhi, kMu);
  const Limit limit = find_friction(packing, "friction", {true, true});
  ASSERT_EQ(limit.smallest.value, 0);
  for (const LimitStep& step : walk_to_limit(packing, limit, limit.smallest, kSteps))
    expect_segment(step, zoo::wedge_ranges(kPhi, step.value * kMu), 1);
}

TEST(LimitWalk, CountsContactsWithoutForceTwice) {
  // A wall beside a disk on a floor bears nothing as long as gravity points along it.
  const Packing corner = zoo::corner(0, 0);
  const Limit tilt = find_tilt(corner);
  const std::vector<LimitStep> turned = walk_to_limit(corner, tilt, tilt.smallest, 2);
  for (const LimitStep& step : turned) {
    EXPECT_EQ(step.most_sliding, step.value == 0 ? 2 : 0);
    EXPECT_EQ(step.sliding, step.most_sliding);
    EXPECT_EQ(step.sliding_error, 0);
  }
}

TEST(LimitWalk, CountsContactsThatSlideInEveryState) {
  Loads gravity;
  gravity.gravity = {0, 0.5};
  const auto expect_sliding = [&](const Packing& packing, int expected) {
    const Limit limit = find_load(packing, "gravity", gravity);
    for (const LimitStep& step : walk_to_limit(packing, limit, limit.largest, 2)) {
      EXPECT_EQ(step.dim, 1);
      EXPECT_EQ(step.converged, 1);
      EXPECT_EQ(step.sliding, expected);
      EXPECT_EQ(step.most_sliding, expected);
    }
  };
  expect_sliding(zoo::wedge(kPhi, kMu), 0);
  expect_sliding(zoo::corner(0.5, 1), 1);               // the wall's contact
  expect_sliding(zoo::wedge_and_corner(kPhi, kMu), 2);  // the wall's contact has no force
}

TEST(LimitWalk, OfAPointIsAPoint) {
  const Packing packing = zoo::wedge(kPhi, 0);
  const Limit limit = find_tilt(packing);
  for (const LimitStep& step : walk_to_limit(packing, limit, limit.largest, 2)) {
    EXPECT_EQ(step.dim, 0);
    for (const auto member : {&LimitStep::mean_delta_R, &LimitStep::largest_delta_T, &LimitStep::r,
                              &LimitStep::inscribed_radius, &LimitStep::mean_width})
      EXPECT_EQ(step.*member, 0);
    EXPECT_TRUE(step.is_certain());
  }
}

TEST(LimitWalk, OfAnUnboundedPolytopeHasRangesButNoSizes) {
  const Packing packing = zoo::column_between_walls(2, 0.3);
  const Limit limit = find_friction(packing, "friction", std::vector<bool>(packing.contacts.size(), true));
  ASSERT_TRUE(limit.has_way_to(limit.smallest));
  for (const LimitStep& step : walk_to_limit(packing, limit, limit.smallest, 2)) {
    EXPECT_EQ(step.largest_delta_R, std::numeric_limits<double>::infinity());
    EXPECT_EQ(step.mean_delta_R, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(step.r));
    EXPECT_TRUE(std::isnan(step.sliding));
    EXPECT_EQ(step.most_sliding, -1);
    EXPECT_EQ(step.converged, -1);
    EXPECT_TRUE(step.is_certain());
  }
}

TEST(LimitWalk, HasNoWayFromAPackingThatIsAtItsLimitOrFalls) {
  const Packing corner = zoo::corner(0, 0);  // gravity may turn towards the wall alone
  const Limit at_it = find_tilt(corner);
  EXPECT_FALSE(at_it.has_way_to(at_it.largest));
  EXPECT_TRUE(at_it.has_way_to(at_it.smallest));
  const Packing incline = zoo::disk_on_incline(0.1, 1);
  const Limit fallen = find_tilt(incline);
  EXPECT_FALSE(fallen.has_way_to(fallen.smallest) || fallen.has_way_to(fallen.largest));
}

TEST(LimitWalk, TellsWhereThereIsNoState) {
  const Packing packing = zoo::wedge(kPhi, kMu);
  Limit limit = find_tilt(packing);
  limit.largest.value = 2 * kPhi;  // twice as far as it stands
  const std::vector<LimitStep> steps = walk_to_limit(packing, limit, limit.largest, 1);
  EXPECT_TRUE(steps.front().is_certain());
  EXPECT_FALSE(steps.back().is_certain());
  EXPECT_EQ(steps.back().dim, -1);
  for (const StepField<double>& field : kStepNumbers)
    EXPECT_TRUE(std::isnan(steps.back().*field.member)) << field.name;
}

TEST(LimitWalk, IsTheSameForAnyNumberOfThreads) {
  const Packing packing = zoo::random_pile(1, 6, 0.5);
  const Limit limit = find_tilt(packing);
  ASSERT_TRUE(limit.has_way_to(limit.largest));
  LimitWalkOptions options;
  const std::vector<LimitStep> alone = walk_to_limit(packing, limit, limit.largest, 1, options);
  options.threads = 3;
  const std::vector<LimitStep> together = walk_to_limit(packing, limit, limit.largest, 1, options);
  ASSERT_EQ(alone.size(), together.size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    for (const StepField<double>& field : kStepNumbers)
      EXPECT_EQ(0, std::memcmp(&(alone[k].*field.member), &(together[k].*field.member), sizeof(double)))
          << field.name;
    for (const StepField<int>& field : kStepCounts)
      EXPECT_EQ(alone[k].*field.member, together[k].*field.member) << field.name;
  }
}

TEST(LimitWalk, StopsWhereItIsToldTo) {
  const Packing packing = zoo::wedge(kPhi, kMu);
  const Limit limit = find_tilt(packing);
  LimitWalkOptions options;
  int calls = 0;
  options.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "steps");
    EXPECT_EQ(progress.total, kSteps + 1);
    return ++calls < 5;
  };
  EXPECT_THROW(walk_to_limit(packing, limit, limit.largest, kSteps, options), Interrupted);
  EXPECT_EQ(calls, 5);
}

}  // namespace
}  // namespace indet
