#include "libindet/limit/tilt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libindet/limit/limit.h"
#include "libindet/limit/mechanism.h"
#include "libindet/limit/tilt_arc.h"
#include "tests/limit/bracket.h"
#include "tests/support/body_variants.h"
#include "tests/support/scene_builder.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

Packing tilted(Packing packing, double angle) {
  packing.gravity = turned(packing.gravity, angle);
  return packing;
}

TEST(Tilt, OfADiskInAGrooveIsTheAngleOfTheGroove) {
  for (const double phi : {0.1, 0.4, 0.9}) {
    const Packing packing = zoo::wedge(phi, 0.3);
    const TiltLimits limits = find_tilt_limits(packing);
    EXPECT_EQ(limits.largest.outcome, LimitOutcome::kReached);
    EXPECT_NEAR(limits.largest.value, phi, 1e-12 * phi);
    EXPECT_NEAR(limits.smallest.value, -phi, 1e-12 * phi);
    EXPECT_LE(limits.largest.upper - limits.largest.lower, 1e-12 * phi);
    EXPECT_TRUE(limits.stands());
    // There one contact has no force, and the disk rolls over the other one.
    EXPECT_EQ(limits.largest.non_transmitting, 1);
    EXPECT_EQ(moving_disks(limits.largest.motion).size(), 1U);
  }
}

TEST(Tilt, OfAWedgedDiskHasNoEnd) {
  const TiltLimits limits = find_tilt_limits(zoo::wedge(1.4, 0.3));  // tan 1.4 > 1/0.3
  EXPECT_EQ(limits.largest.outcome, LimitOutcome::kNever);
  EXPECT_EQ(limits.smallest.outcome, LimitOutcome::kNever);
  EXPECT_TRUE(limits.stands());
  for (int k = 0; k < 12; ++k) EXPECT_TRUE(test::stands(tilted(zoo::wedge(1.4, 0.3), k * 0.5)));
}

TEST(Tilt, TowardsAWallIsARightAngleAndFromItNothing) {
  Packing packing = zoo::corner(0, 0);  // floor, and a wall at the left: gravity may turn clockwise
  const TiltLimits limits = find_tilt_limits(packing);
  EXPECT_NEAR(limits.smallest.value, -std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(limits.largest.value, 0);
  EXPECT_EQ(limits.largest.outcome, LimitOutcome::kReached);
}

TEST(Tilt, OfWhatCannotStandIsWhereItCould) {
  Packing packing = zoo::wedge(0.4, 0.3);
  packing.gravity = turned(packing.gravity, 1.0);
  const TiltLimits limits = find_tilt_limits(packing);
  EXPECT_FALSE(limits.stands());
  EXPECT_NEAR(limits.largest.value, -0.6, 1e-12);
  EXPECT_NEAR(limits.smallest.value, -1.4, 1e-12);
  const TiltLimits none = find_tilt_limits(zoo::disk_on_incline(0.1, 1));
  EXPECT_FALSE(none.stands());
}

TEST(Tilt, OfPilesIsWhereTheyFallByExactArithmetic) {
  int reached = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const Packing packing = zoo::random_pile(seed, 6, 0.5);
    const TiltLimits limits = find_tilt_limits(packing);
    if (!test::stands(packing)) {
      EXPECT_FALSE(limits.stands());
      continue;
    }
    EXPECT_TRUE(limits.stands());
    const auto at = [&](double angle) { return tilted(packing, angle); };
    for (const auto& [end, sign] : {std::pair(&limits.largest, 1), std::pair(&limits.smallest, -1)}) {
      if (end->outcome == LimitOutcome::kNever) continue;
      test::expect_end(*end, sign, at, 1e-9);
      ++reached;
    }
  }
  EXPECT_GE(reached, 6);
}

TEST(Tilt, OfAnArcAgreesWithThatOfACone) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Packing packing = zoo::random_pile(seed, 6, 0.5);
    const TiltLimits cone = find_tilt_limits(packing);
    ASSERT_TRUE(cone.stands()) << seed;
    const TiltLimits arc = find_tilt_arc(packing, {});
    EXPECT_NEAR(arc.largest.value, cone.largest.value, 1e-11);
    EXPECT_NEAR(arc.smallest.value, cone.smallest.value, 1e-11);
    EXPECT_LE(arc.largest.lower, cone.largest.upper);
    EXPECT_GE(arc.largest.upper, cone.largest.lower);
  }
}

TEST(Tilt, UnderAPistonIsWhereItFallsByExactArithmetic) {
  // Weights 1, pressed by 2 in all under a plate that is held along itself.
  Packing packing = zoo::disks_between_plates(2, 2, 0.4);
  const TiltLimits limits = find_tilt_limits(packing);
  EXPECT_TRUE(limits.is_first_of_several);
  ASSERT_TRUE(limits.stands());
  const auto at = [&](double angle) { return tilted(packing, angle); };
  for (const auto& [end, sign] : {std::pair(&limits.largest, 1), std::pair(&limits.smallest, -1)}) {
    test::expect_end(*end, sign, at, 1e-9);
    // Each disk is held by two equal tangential forces, sin θ/2 ≤ μ R of the plate, R = 1.
    EXPECT_NEAR(end->value, sign * std::asin(0.8), 1e-11);
  }
  for (double angle = -0.9; angle < 0.95; angle += 0.1) EXPECT_TRUE(test::stands(at(angle)));
}

TEST(Tilt, TakesOutDisksThatRollAway) {
  // A disk in a groove, and one on a floor that nothing holds.
  Packing packing = zoo::wedge(0.4, 0.3);
  const WallId floor = zoo::add_wall(packing, {0, -10}, {0, 1});
  const DiskId loose = zoo::add_disk(packing, {20, -9});
  zoo::touch(packing, loose, Body::wall(floor), 0.3);
  EXPECT_EQ(find_tilt(packing).largest.value, 0);
  const Limit limit = find_tilt(packing, 0.2);
  ASSERT_EQ(limit.left_out.size(), 1U);
  EXPECT_EQ(limit.left_out.front(), loose);
  EXPECT_NEAR(limit.largest.value, 0.4, 1e-12);
  EXPECT_EQ(limit.largest.forces.value().size(), 2 * packing.contact_count());
  EXPECT_TRUE(limit.largest.forces.value().tail(2).isZero(0));
}

TEST(Tilt, KeepsADiskWithoutWhichOthersFall) {
  // A smooth disk between two walls lies on a smaller one, which nothing holds sideways: it moves alone, but
  // carries the other one.
  Packing packing = zoo::empty_scene();
  const DiskId upper = zoo::add_disk(packing, {0, 2});
  const DiskId lower = zoo::add_disk(packing, {0, 0.5}, 0.5);
  zoo::touch(packing, lower, Body::wall(zoo::add_wall(packing, {0, 0}, {0, 1})), 0);
  zoo::touch(packing, upper, Body::disk(lower), 0);
  zoo::touch(packing, upper, Body::wall(zoo::add_wall(packing, {-1, 0}, {1, 0})), 0);
  zoo::touch(packing, upper, Body::wall(zoo::add_wall(packing, {1, 0}, {-1, 0})), 0);
  const Limit limit = find_tilt(packing, 0.5);
  EXPECT_EQ(moving_disks(limit.largest.motion), std::vector<DiskId>{lower});
  EXPECT_EQ(limit.largest.value, 0);
  EXPECT_TRUE(limit.left_out.empty());
}

}  // namespace
}  // namespace indet
