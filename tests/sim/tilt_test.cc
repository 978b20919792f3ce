#include "libsim/tilt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "libindet/base/error.h"
#include "libsim/contact_memory.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

constexpr double kTimeLimit = 40;

/// A disk in a groove of two walls, whose normals are turned from the vertical by `left` and `right`.
///
///     \  ___  /        It rolls, or slides without friction, out over the wall on the right once gravity,
///      \/   \/         turned counter-clockwise, has left the cone of the normals: θ_c = right. And to the
///       \___/          other side beyond −left.
World groove(double left, double right, double mu) {
  World world = empty_world(mu);
  add_wall(world, {0, 0}, {std::sin(left), std::cos(left)});
  add_wall(world, {0, 0}, {-std::sin(right), std::cos(right)});
  // The centre is at distance 1 of both.
  const double sum = std::sin(left + right);
  add_disk(world, {(std::cos(right) - std::cos(left)) / sum, (std::sin(left) + std::sin(right)) / sum});
  return world;
}

/// A disk on two that are fixed, side by side: θ_c = ±30°.
World disk_on_two_fixed(double mu) {
  World world = empty_world(mu);
  add_disk(world, {0, std::sqrt(3.0)});
  add_disk(world, {-1, 0});
  add_disk(world, {1, 0});
  world.fixed[1] = world.fixed[2] = 1;
  return world;
}

TiltOptions at_rate(double degrees) {
  return {.rate = degrees * kDegree, .angle_limit = 90 * kDegree, .row_interval = 0.5 * kDegree};
}

Tilt tilt_after_rest(const World& world, Kind kind, const TiltOptions& how) {
  const Packing packing = simulate(world, {}, options_of(kind, kTimeLimit)).packing;
  return tilt(packing, world.friction, options_of(kind, kTimeLimit), how);
}

/// What a disk that has yielded adds to the angle before it has moved by the distance (tilt.h).
double delay(const TiltOptions& how, double share_of_gravity) {
  return std::cbrt(6 * how.distance * how.rate * how.rate / share_of_gravity);
}

class Tilting : public ::testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Tilting, ::testing::Values(Kind::kContactDynamics, Kind::kStiff, Kind::kPaper),
                         [](const auto& instance) { return name_of(instance.param); });

TEST_P(Tilting, SmoothDiskSlidesOutOfAGrooveWhereGravityLeavesTheCone) {
  const World world = groove(8 * kDegree, 12 * kDegree, 0);
  for (const double rate : {0.2, -0.2}) {
    const TiltOptions how = at_rate(rate);
    const Tilt result = tilt_after_rest(world, GetParam(), how);
    const double expected = (rate > 0 ? 12 : 8) * kDegree + delay(how, 1);
    EXPECT_NEAR(std::copysign(1, rate) * result.moved_at[0], expected, 0.03 * delay(how, 1));
    EXPECT_EQ(result.angle(), result.moved_at[0]);
    EXPECT_EQ(result.moved, 1);
  }
}

TEST_P(Tilting, RoughDiskRollsOutOfAGrooveWhereGravityLeavesTheCone) {
  const World world = groove(8 * kDegree, 12 * kDegree, 0.3);
  for (const double rate : {0.2, -0.2}) {
    const TiltOptions how = at_rate(rate);
    const Tilt result = tilt_after_rest(world, GetParam(), how);
    const double expected = (rate > 0 ? 12 : 8) * kDegree + delay(how, 2.0 / 3);
    EXPECT_NEAR(std::copysign(1, rate) * result.moved_at[0], expected, 0.03 * delay(how, 2.0 / 3));
  }
}

TEST_P(Tilting, DiskRollsOffTwoOthersAtThirtyDegrees) {
  const TiltOptions how = at_rate(0.4);
  const Tilt result = tilt_after_rest(disk_on_two_fixed(0.5), GetParam(), how);
  EXPECT_NEAR(result.moved_at[0], 30 * kDegree + delay(how, 2.0 / 3), 0.05 * delay(how, 2.0 / 3));
  EXPECT_TRUE(std::isnan(result.moved_at[1]));
}

TEST_P(Tilting, HalfTheRateBringsTheAngleNearerByTheDelay) {
  const World world = groove(8 * kDegree, 8 * kDegree, 0.3);
  const double fast = tilt_after_rest(world, GetParam(), at_rate(0.4)).moved_at[0] - 8 * kDegree;
  const double slow = tilt_after_rest(world, GetParam(), at_rate(0.2)).moved_at[0] - 8 * kDegree;
  EXPECT_NEAR(slow / fast, std::pow(0.5, 2.0 / 3), 0.03);
}

TEST_P(Tilting, LeavesTheLastStateThatRestsUnderTurnedGravity) {
  const TiltOptions how = at_rate(0.2);
  const Tilt result = tilt_after_rest(groove(8 * kDegree, 12 * kDegree, 0.3), GetParam(), how);
  // Rows are at multiples of 0.5°, and at 12.5° the disk rolls.
  EXPECT_NEAR(result.rest_angle, 12 * kDegree, how.row_interval + 1e-3);
  EXPECT_LT(result.rest_angle, 12 * kDegree + 1e-3);
  const Packing& packing = result.rest.packing;
  EXPECT_NEAR(packing.gravity.x(), std::sin(result.rest_angle), 1e-15);
  EXPECT_NEAR(packing.gravity.y(), -std::cos(result.rest_angle), 1e-15);
  EXPECT_LE(balance_residual(packing, packing.simulated_forces().value()), 1e-12);
  EXPECT_THAT(result.rest.settled.reason, HasSubstr("gravity held at"));
}

TEST_P(Tilting, RowsTellOfStatesAtEqualIntervals) {
  TiltOptions how = at_rate(-0.4);
  how.angle_limit = 3.2 * kDegree;
  const Tilt result = tilt_after_rest(groove(8 * kDegree, 12 * kDegree, 0.3), GetParam(), how);
  ASSERT_EQ(result.rows.size(), 8);  // 0°, −0.5° … −3°, and the limit
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(result.rows[i].angle, -0.5 * i * kDegree, 1e-4);
  EXPECT_EQ(result.rows.back().angle, -how.angle_limit);
  EXPECT_EQ(result.moved, 0);
  EXPECT_EQ(result.rest_angle, -how.angle_limit);
  for (const TiltRow& row : result.rows) {
    EXPECT_EQ(row.contacts, 2);
    EXPECT_LT(row.displacement, 1e-5);
    EXPECT_LT(row.kinetic_energy, 1e-9);
  }
}

/// A disk that fell into the groove askew: of the forces by which walls and friction can hold it, it has some
/// that a start without memory does not find.
TEST_P(Tilting, StartsFromTheForcesThatContactsRemember) {
  const World world = groove(25 * kDegree, 25 * kDegree, 0.5);
  const SimulationOptions options = options_of(GetParam(), kTimeLimit);
  World dropped = world;
  dropped.y[0] += 0.5;
  dropped.vx[0] = 0.3;
  Packing packing = simulate(dropped, {}, options).packing;
  TiltOptions how = at_rate(0.4);
  how.angle_limit = 0.1 * kDegree;
  EXPECT_LT(tilt(packing, world.friction, options, how).start_distance, 1e-3);
  // The same where the file has the contacts, and the bodies of each, in another order.
  std::reverse(packing.contacts.begin(), packing.contacts.end());
  EXPECT_LT(tilt(packing, world.friction, options, how).start_distance, 1e-3);
}

TEST(Tilt, MemoryHasContactsInTheOrderOfTheSteppers) {
  Packing packing =
      simulate(disk_on_two_fixed(0.5), {}, options_of(Kind::kContactDynamics, kTimeLimit)).packing;
  ASSERT_EQ(packing.contact_count(), 2);
  const Contact first = packing.contacts[0];
  Contact& turned = packing.contacts[0];
  turned.a = first.b.disk_id();
  turned.b = Body::from_code(first.a.value());
  turned.normal = -first.normal;
  std::swap(packing.contacts[0], packing.contacts[1]);
  const auto memory = contact_memory(packing, world_of(packing, {}).units(), contact_dynamics(1));
  ASSERT_EQ(memory.size(), 2);
  EXPECT_EQ(std::pair(memory[0].a, memory[0].b), std::pair(first.a.value(), first.b.code()));
  EXPECT_EQ(Vector2(memory[0].nx, memory[0].ny), first.normal);
  EXPECT_EQ(memory[0].T, first.T);
  EXPECT_LT(memory[0].b, memory[1].b);
  EXPECT_EQ(force_distance(packing, memory), 0);
}

TEST(Tilt, RefusesWhatCannotBeTilted) {
  const World world = groove(8 * kDegree, 12 * kDegree, 0.3);
  const SimulationOptions options = contact_dynamics(40);
  Packing packing = simulate(world, {}, options).packing;
  const auto reason = [&](const TiltOptions& how) {
    try {
      tilt(packing, world.friction, options, how);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(reason(at_rate(0)), HasSubstr("rate"));
  TiltOptions how = at_rate(0.2);
  how.most_moved = 2;
  EXPECT_THAT(reason(how), HasSubstr("2 of 1 disks"));
  EXPECT_THAT(reason(at_rate(1e-14)), HasSubstr("time steps away"));
  // It slides out at once.
  packing.gravity = {std::sin(20 * kDegree), -std::cos(20 * kDegree)};
  EXPECT_THAT(reason(at_rate(0.2)), HasSubstr("disk 0 moves by"));
  packing.contacts[0].R = std::nan("");
  EXPECT_THAT(reason(at_rate(0.2)), HasSubstr("forces of contact 0 are not known"));
}

}  // namespace
}  // namespace indet::sim
