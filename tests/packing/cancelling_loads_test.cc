#include "libindet/packing/cancelling_loads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "libindet/base/error.h"
#include "tests/support/body_variants.h"
#include "tests/support/scene_builder.h"

namespace indet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<bool> loaded(const Packing& packing) {
  std::vector<bool> result;
  for (const Wall& wall : packing.walls) result.push_back(wall.is_loaded());
  return result;
}

TEST(CancellingLoads, StayWhereAFixedWallTakesTheirSum) {
  Packing packing = zoo::biaxial_box(2, 2, 1, 2, 0.3);
  EXPECT_THAT(take_out_cancelling_loads(packing), ElementsAre());
  EXPECT_THAT(loaded(packing), ElementsAre(false, false, true, true));
}

TEST(CancellingLoads, LeaveOneWallOfTwoPlatesHeld) {
  Packing packing = zoo::disks_between_plates(2, 3, 0);
  packing.walls[0].load_n = 5;  // 3, and the weight of two disks
  EXPECT_THAT(take_out_cancelling_loads(packing), ElementsAre(HasSubstr("load_n of wall 2")));
  EXPECT_THAT(loaded(packing), ElementsAre(true, false));
}

TEST(CancellingLoads, MustCancel) {
  Packing packing = zoo::disks_between_plates(2, 3, 0);
  packing.walls[0].load_n = 4;
  EXPECT_THAT([&] { take_out_cancelling_loads(packing); },
              ThrowsMessage<InputError>(HasSubstr("their sum is 1, not 0")));
}

/// With friction the tangent of the floor takes what is sideways. Without it nothing does, but then no
/// contact pushes the plate sideways either, and its load there stays, to be found impossible.
TEST(CancellingLoads, AlongATangentAreThoseOfWallsWithFriction) {
  for (const double mu : {0.0, 0.3}) {
    Packing packing = zoo::disks_between_plates(2, 3, mu);
    packing.walls[0].load_n = 5;
    packing.walls[1].load_t = 0.5;
    const std::size_t taken = take_out_cancelling_loads(packing).size();
    EXPECT_EQ(taken, 1U);
    EXPECT_TRUE(packing.walls[1].is_free_along_tangent());
  }
}

TEST(CancellingLoads, AFixedDiskTakesAllDirections) {
  Packing packing = zoo::disks_between_plates(2, 3, 0);
  packing.walls[0].load_n = 1;
  for (Disk& disk : packing.disks) disk.fixed = true;
  EXPECT_THAT(take_out_cancelling_loads(packing), ElementsAre());
}

TEST(CancellingLoads, OfThreeWallsInARackLeaveOne) {
  Packing packing = zoo::rack(2);
  EXPECT_EQ(take_out_cancelling_loads(packing).size(), 2U);
  EXPECT_THAT(loaded(packing), ElementsAre(true, false, false));
  packing = zoo::rack(2);
  packing.walls[1].load_n = 2.1;
  EXPECT_THROW(take_out_cancelling_loads(packing), InputError);
}

/// Two pairs of plates side by side: each pair must balance by itself.
TEST(CancellingLoads, AreAddedUpForEachGroupOfBodies) {
  Packing packing = zoo::disks_between_plates(1, 3, 0);
  packing.walls[0].load_n = 4;
  const DiskId other = zoo::add_disk(packing, {10, 1});
  const WallId floor = zoo::add_wall(packing, {0, 0}, {0, 1});
  const WallId plate = zoo::add_wall(packing, {0, 2}, {0, -1});
  zoo::touch(packing, other, Body::wall(floor), 0);
  zoo::touch(packing, other, Body::wall(plate), 0);
  packing.walls[2].load_n = 8;
  packing.walls[3].load_n = 7;
  EXPECT_EQ(take_out_cancelling_loads(packing).size(), 2U);
  EXPECT_THAT(loaded(packing), ElementsAre(true, false, true, false));
  packing.walls[3].load_n = 6;
  EXPECT_THROW(take_out_cancelling_loads(packing), InputError);
}

}  // namespace
}  // namespace indet
