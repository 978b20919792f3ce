#include "libindet/limit/friction_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/limit/bracket.h"
#include "tests/support/scene_builder.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

std::vector<bool> all(const Packing& packing) { return std::vector<bool>(packing.contacts.size(), true); }

TEST(FrictionLimit, OfThreeEqualCylinders) {
  // Sec. "pyramid" of the zoo: tan 15° between cylinders, a third of it on the floor.
  const double angle = std::numbers::pi / 6;
  const double upper = 2 - std::sqrt(3);
  for (const auto& [mu_upper, mu_floor] : {std::pair(0.9, 0.9), std::pair(0.9, 0.2)}) {
    const Packing packing = zoo::pyramid(angle + 1e-3, mu_upper, mu_floor);
    const double needed = std::tan((angle + 1e-3) / 2);
    const FrictionLimit limit = find_friction_limit(packing, all(packing));
    const double expected = std::max(needed / mu_upper, needed / 3 / mu_floor);
    EXPECT_EQ(limit.infimum.outcome, LimitOutcome::kReached);
    EXPECT_NEAR(limit.infimum.value, expected, 2e-12 * expected);
    EXPECT_LE(limit.infimum.upper - limit.infimum.lower, 3e-12 * expected);
    EXPECT_TRUE(limit.is_attained);
  }
  // Of the floor alone; at exactly 30° both contacts below are gone.
  const Packing packing = zoo::pyramid(angle, 0.9, 0.9);
  std::vector<bool> floor(packing.contacts.size(), false);
  for (std::size_t i = 0; i < floor.size(); ++i) floor[i] = packing.contacts[i].b.is_wall();
  const FrictionLimit limit = find_friction_limit(packing, floor);
  EXPECT_NEAR(limit.infimum.value, upper / 3 / 0.9, 1e-12);
}

TEST(FrictionLimit, IsNotAttainedWhereForcesGrowWithoutLimit) {
  const Packing packing = zoo::pinched_disk(0.4);
  const FrictionLimit limit = find_friction_limit(packing, all(packing));
  EXPECT_EQ(limit.infimum.outcome, LimitOutcome::kReached);
  EXPECT_EQ(limit.infimum.value, 0);
  EXPECT_LE(limit.infimum.upper, 1e-9);
  EXPECT_FALSE(limit.is_attained);
}

TEST(FrictionLimit, NoneIsNeeded) {
  const Packing packing = zoo::wedge(0.4, 0.3);
  const FrictionLimit limit = find_friction_limit(packing, all(packing));
  EXPECT_EQ(limit.infimum.outcome, LimitOutcome::kReached);
  EXPECT_EQ(limit.infimum.upper, 0);
  EXPECT_TRUE(limit.is_attained);
}

TEST(FrictionLimit, NoneSuffices) {
  const Packing packing = zoo::disk_on_incline(0.1, 1);
  const FrictionLimit limit = find_friction_limit(packing, all(packing));
  EXPECT_EQ(limit.infimum.outcome, LimitOutcome::kNoState);
  EXPECT_GE(limit.infimum.lower, 1e6);
}

TEST(FrictionLimit, OfPilesIsWhereTheyFallByExactArithmetic) {
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Packing packing = zoo::random_pile(seed, 4, 0.5);
    const FrictionLimit limit = find_friction_limit(packing, all(packing));
    EXPECT_NE(limit.infimum.outcome, LimitOutcome::kUndecided) << seed;
    if (limit.infimum.outcome != LimitOutcome::kReached || limit.infimum.value == 0) continue;
    const auto at = [&](double factor) { return with_friction(packing, all(packing), factor); };
    test::expect_end(limit.infimum, -1, at, 1e-9 * limit.infimum.value);
    ++reached;
  }
  EXPECT_GE(reached, 3);
}

TEST(FrictionLimit, WhereSomeContactsTransmitNothingWhateverTheFriction) {
  // A disk that touches floor and wall with μ < 1 does not press on the wall: with any friction some edges
  // are closed. Beside it a pyramid that needs friction.
  Packing packing = zoo::pyramid(0.6, 0.5, 0.5);
  const WallId wall = zoo::add_wall(packing, {50, 0}, {-1, 0});
  const DiskId disk = zoo::add_disk(packing, {49, packing.disks[0].position.y()});
  zoo::touch(packing, disk, packing.contacts[2].b, 0.3);
  zoo::touch(packing, disk, Body::wall(wall), 0.3);
  const FrictionLimit limit = find_friction_limit(packing, all(packing));
  EXPECT_NEAR(limit.infimum.value, std::tan(0.3) / 0.5, 1e-11);
  EXPECT_EQ(limit.infimum.outcome, LimitOutcome::kReached);
}

TEST(FrictionLimit, OfDegeneratePilesIsWhereTheyFallByExactArithmetic) {
  for (const int base : {2, 3}) {
    const Packing packing = zoo::lattice_pile(base, 0.5);
    const FrictionLimit limit = find_friction_limit(packing, all(packing));
    const auto at = [&](double factor) { return with_friction(packing, all(packing), factor); };
    test::expect_end(limit.infimum, -1, at, 1e-9 * limit.infimum.value);
    EXPECT_LE(limit.infimum.upper - limit.infimum.lower, 1e-11);
  }
}

}  // namespace
}  // namespace indet
