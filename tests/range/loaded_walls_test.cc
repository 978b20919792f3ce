#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "libindet/packing/cancelling_loads.h"
#include "libindet/range/analyze.h"
#include "tests/support/body_variants.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

TEST(LoadedWalls, PressADiskAgainstTheFloor) {
  for (const double mu : {0.0, 0.3}) {
    const ForceRanges ranges = analyze(zoo::disks_between_plates(1, 2.5, mu));
    EXPECT_EQ(ranges.status, PolytopeStatus::kPoint);
    EXPECT_EQ(ranges.certified, 8);
    EXPECT_NEAR(ranges.value(0, kMinR), 3.5, 1e-14);
    EXPECT_NEAR(ranges.value(1, kMaxR), 2.5, 1e-14);
    EXPECT_NEAR(ranges.value(0, kMaxT), 0, 1e-14);
  }
}

TEST(LoadedWalls, ShareTheirLoadAmongTheDisksBelow) {
  constexpr int kCount = 4;
  for (const double mu : {0.0, 0.3}) {
    const Packing packing = zoo::disks_between_plates(kCount, 2.5, mu);
    const ForceRanges ranges = analyze(packing);
    EXPECT_EQ(ranges.status, PolytopeStatus::kBounded);
    EXPECT_EQ(ranges.dim, kCount - 1);
    EXPECT_EQ(ranges.certified, 8 * kCount);
    for (int i = 0; i < kCount; ++i) {
      EXPECT_NEAR(ranges.value(i, kMinR), 1, 1e-13);
      EXPECT_NEAR(ranges.value(i, kMaxR), 3.5, 1e-13);
      EXPECT_NEAR(ranges.value(kCount + i, kMinR), 0, 1e-13);
      EXPECT_NEAR(ranges.value(kCount + i, kMaxR), 2.5, 1e-13);
    }
  }
}

/// A plate that is free along its tangent must not be pushed there: the disk below would roll.
TEST(LoadedWalls, RollAwayUnderATangentialLoad) {
  Packing packing = zoo::disks_between_plates(1, 2.5, 0.3);
  packing.walls[1].load_t = 0;
  EXPECT_EQ(analyze(packing).status, PolytopeStatus::kPoint);
  packing.walls[1].load_t = 0.1;
  const ForceRanges ranges = analyze(packing);
  ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
  EXPECT_FALSE(ranges.doubtful);
  ASSERT_EQ(ranges.wall_motion.rows(), 2);
  EXPECT_TRUE(ranges.wall_motion.row(0).isZero(0));
  // Rolling: the plate moves along t̂ = (−1, 0) twice as fast as the centre, which turns with r ω = −v_x.
  const double plate = ranges.wall_motion(1, 1);
  EXPECT_GT(plate, 0);
  EXPECT_NEAR(ranges.motion(0, 0), -plate / 2, 1e-12);
  EXPECT_NEAR(ranges.motion(0, 2), plate / 2, 1e-12);
}

/// A plate that nothing supports falls alone.
TEST(LoadedWalls, MoveWhereNothingTouchesThem) {
  Packing packing = zoo::disk_on_floor(0.3);
  packing.walls.push_back(Wall{.id = 7, .point = {0, 5}, .normal = {0, -1}, .name = "lid", .load_n = 1});
  const ForceRanges ranges = analyze(packing);
  ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
  EXPECT_TRUE(ranges.motion.isZero(0));
  EXPECT_EQ(ranges.wall_motion(1, 0), 1);
  packing.walls[1].load_n = 0;
  EXPECT_EQ(analyze(packing).status, PolytopeStatus::kPoint);
}

TEST(LoadedWalls, PressABiaxialBox) {
  const ForceRanges ranges = analyze(zoo::biaxial_box(3, 2, 2, 0.5, 0));
  EXPECT_EQ(ranges.status, PolytopeStatus::kBounded);
  EXPECT_EQ(ranges.certified, ranges.objectives);
  EXPECT_EQ(ranges.dim, 1 + 2) << "two rows share one load, three columns the other";
  for (Eigen::Index i = 0; i < ranges.value.rows(); ++i) {
    EXPECT_NEAR(ranges.value(i, kMinR), 0, 1e-13);
    EXPECT_NEAR(ranges.value(i, kMaxR), i < 8 ? 2 : 0.5, 1e-13) << i;
  }
}

TEST(LoadedWalls, GiveRangesProportionalToTheirLoads) {
  const ForceRanges one = analyze(zoo::biaxial_box(3, 3, 1, 2, 0.4));
  const ForceRanges many = analyze(zoo::biaxial_box(3, 3, 7, 14, 0.4));
  EXPECT_EQ(one.status, PolytopeStatus::kBounded);
  EXPECT_EQ(one.certified, one.objectives);
  EXPECT_TRUE(test::same_entries(7 * one.value, many.value, 1e-9));
}

TEST(LoadedWalls, PressARack) {
  Packing packing = zoo::rack(2);
  EXPECT_EQ(take_out_cancelling_loads(packing).size(), 2U);
  const ForceRanges ranges = analyze(packing);
  ASSERT_EQ(ranges.status, PolytopeStatus::kBounded);
  EXPECT_EQ(ranges.dim, 2);
  EXPECT_EQ(ranges.certified, 36);
  for (const int pair : {2, 5, 8}) {
    EXPECT_NEAR(ranges.value(pair, kMinR), 0, 1e-12);
    EXPECT_NEAR(ranges.value(pair, kMaxR), std::sqrt(3.0), 1e-12);
  }
}

TEST(LoadedWalls, RangesAreThoseOfAllVertices) {
  int standing = 0;
  EXPECT_TRUE(rc::check([&] {
    const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000000);
    Packing packing = zoo::random_pile(seed, *rc::gen::inRange(2, 5), -1);
    packing.walls[*rc::gen::inRange<std::size_t>(1, packing.walls.size())].load_n =
        *rc::gen::element(0.0, 0.5, 2.0);
    const ForceRanges ranges = analyze(packing);
    const oracle::States states = oracle::enumerate_states(packing);
    RC_ASSERT(ranges.dim == states.dim);
    standing += states.dim >= 0 ? 1 : 0;
    for (int i = 0; states.dim >= 0 && i < packing.contact_count(); ++i) {
      for (int column = 0; column < 4; ++column) {
        const auto exact =
            oracle::extremum(states, 2 * i + (column >= kMinT ? 1 : 0), column % 2 == 0 ? -1 : 1);
        RC_ASSERT(test::near(exact.value, ranges.value(i, column) / ranges.force_unit, 1e-8));
      }
    }
  }));
  EXPECT_GT(standing, 5);
}

}  // namespace
}  // namespace indet
