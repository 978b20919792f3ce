#include "libsim/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "libindet/base/error.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

using ::testing::HasSubstr;

/// Mechanics of a few disks: the answers are the same for all methods, up to their time step and stiffness.
class Mechanics : public ::testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Mechanics,
                         ::testing::Values(Kind::kContactDynamics, Kind::kStiff, Kind::kPaper),
                         [](const auto& instance) { return name_of(instance.param); });

TEST_P(Mechanics, FallingDiskStopsOnTheFloorAndCarriesItsWeight) {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {0, 3});
  const Simulation result = simulate(world, {}, options_of(GetParam(), 20));
  EXPECT_EQ(result.settled.ending, Ending::kStatic) << result.settled.reason;
  ASSERT_EQ(result.packing.contact_count(), 1);
  EXPECT_NEAR(result.packing.disks[0].position.y(), 1, 2e-6);
  EXPECT_NEAR(result.packing.contacts[0].R / world.mass[0], 1, 1e-12);
  EXPECT_NEAR(result.packing.contacts[0].T, 0, 1e-12);
}

TEST_P(Mechanics, SlidingDiskEndsRollingAtTwoThirdsOfItsSpeed) {
  World world = disk_on_incline(0, 0.3);
  world.vx[0] = 1;
  // Sliding ends at t = v/(3 μ g) = 1.1.
  const World after = run(world, options_of(GetParam(), 1), 3);
  EXPECT_NEAR(after.vx[0], 2.0 / 3, 3e-3);
  EXPECT_NEAR(after.vx[0] + world.radius[0] * after.omega[0], 0, 3e-3);
}

TEST_P(Mechanics, DiskRollsDownAGentleIncline) {
  const double slope = std::atan(0.8 * 3 * 0.3);
  const World after = run(disk_on_incline(slope, 0.3), options_of(GetParam(), 1), 2);
  EXPECT_NEAR(after.vx[0], 2.0 / 3 * std::sin(slope) * 2, 5e-3);
}

TEST_P(Mechanics, DiskSlipsDownASteepIncline) {
  const double slope = std::atan(1.3 * 3 * 0.3);
  const World after = run(disk_on_incline(slope, 0.3), options_of(GetParam(), 1), 2);
  EXPECT_NEAR(after.vx[0], (std::sin(slope) - 0.3 * std::cos(slope)) * 2, 5e-3);
  EXPECT_GT(after.vx[0], std::abs(after.omega[0]) + 0.05);
}

/// Three equal disks. The force between the top disk and a lower one must pass through the lower one's point
/// on the floor, 15° from the contact normal, so the pyramid stands if μ ≥ tan 15° = 0.268 between disks (and
/// a third of that on the floor).
///
///         O
///        O O
///     =========
World pyramid(double mu) {
  World world = empty_world(mu);
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {-1, 1});
  add_disk(world, {1, 1});
  add_disk(world, {0, 1 + std::sqrt(3.0)});
  return world;
}

TEST_P(Mechanics, PyramidStandsAboveItsCriticalFriction) {
  const Simulation result = simulate(pyramid(0.28), {}, options_of(GetParam(), 20));
  EXPECT_EQ(result.settled.ending, Ending::kStatic) << result.settled.reason;
  EXPECT_NEAR(result.packing.disks[2].position.y(), 1 + std::sqrt(3.0), 1e-3);
  EXPECT_TRUE(result.polished.balanced) << result.polished.reason;
}

TEST_P(Mechanics, PyramidFallsBelowItsCriticalFriction) {
  const World after = run(pyramid(0.25), options_of(GetParam(), 1), 20);
  EXPECT_LT(after.y[2], 1.1);
}

/// A disk in a notch, as in Fig. 2 of McNamara and Herrmann: all values of one free force a are admissible
/// between a_min and a_max, and R = mg/2 cos φ + a sin φ on both sides.
TEST_P(Mechanics, ForcesInANotchAreInsideTheAnalyticRange) {
  const double phi = std::numbers::pi / 8;
  const double mu = 0.3;
  World world = empty_world(mu);
  add_wall(world, {0, 0}, {std::sin(phi), std::cos(phi)});
  add_wall(world, {0, 0}, {-std::sin(phi), std::cos(phi)});
  add_disk(world, {0, 1 / std::cos(phi) + 0.5});
  const Simulation result = simulate(world, {}, options_of(GetParam(), 30));
  ASSERT_EQ(result.packing.contact_count(), 2);
  const double half = 0.5;
  const double a_min = -half * (mu - std::tan(phi)) / (1 + mu * std::tan(phi));
  const double a_max = half * (mu + std::tan(phi)) / (1 - mu * std::tan(phi));
  for (const Contact& contact : result.packing.contacts) {
    const double R = contact.R / world.mass[0];
    EXPECT_GE(R, half * std::cos(phi) + a_min * std::sin(phi) - 1e-9);
    EXPECT_LE(R, half * std::cos(phi) + a_max * std::sin(phi) + 1e-9);
  }
}

TEST(Simulate, SettlesASmallSceneInBalanceWithEveryMethod) {
  Scene scene;
  scene.disks = 20;
  scene.seed = 3;
  const World world = build(scene);
  const double limit = default_time_limit(world, scene.resolved().height);
  for (const Kind kind : {Kind::kContactDynamics, Kind::kStiff, Kind::kPaper}) {
    const Simulation result = simulate(world, {}, options_of(kind, limit));
    EXPECT_TRUE(result.polished.balanced) << result.polished.reason;
    EXPECT_LE(result.polished.residual, 1e-12);
    EXPECT_EQ(result.polished.cone_violation, 0);
    EXPECT_GE(2 * result.packing.contact_count(), 3 * 20 - 1);
    // Contact dynamics leaves overlaps alone, about 3e-7 in most scenes.
    EXPECT_LT(result.mean_overlap, kind == Kind::kContactDynamics ? 1e-6 : 1e-5);
    EXPECT_GE(result.largest_overlap, result.mean_overlap);
  }
}

/// What keeps overlaps from growing is that no step lets disks in contact approach: at rest there is nothing
/// to grow.
TEST(Simulate, OverlapsDoNotGrowAtRest) {
  Scene scene;
  scene.disks = 20;
  scene.seed = 3;
  const World world = build(scene);
  const double limit = default_time_limit(world, scene.resolved().height);
  SimulationOptions options = contact_dynamics(limit);
  options.kinetic_energy = 0;  // Never called static.
  const Simulation once = simulate(world, {}, options);
  options.time_limit = 10 * limit;
  const Simulation longer = simulate(world, {}, options);
  EXPECT_EQ(longer.settled.ending, Ending::kTimeLimit);
  EXPECT_GT(once.largest_overlap, 0);
  EXPECT_LE(longer.largest_overlap, once.largest_overlap * (1 + 1e-6));
}

/// From no forces, the first step is swept until it is solved, however many contacts its forces have to pass:
/// a column of 40 disks stands at once. With the sweeps of other steps alone it would be far from that.
TEST(Simulate, AStepFromNoForcesIsSweptUntilItIsSolved) {
  constexpr int kDisks = 40;
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  for (int i = 0; i < kDisks; ++i) add_disk(world, {0, 2.0 * i + 1});
  const auto first_step = [&](int start_sweeps) {
    SimulationOptions options = contact_dynamics(1);
    options.contact_dynamics.start_sweeps = start_sweeps;
    const auto stepper = make_stepper(world, {}, options);
    stepper->advance(1);
    return imbalance_of(stepper->world(), stepper->forces()).worst();
  };
  EXPECT_LT(first_step(ContactDynamicsOptions{}.start_sweeps), 1e-2);
  EXPECT_GT(first_step(ContactDynamicsOptions{}.max_sweeps), 0.5);
}

TEST(Simulate, SlidingContactsOfTheRawStateAreCounted) {
  // Too steep to stand: the disk slips, its one contact is at the limit.
  const Simulation slips = simulate(disk_on_incline(1.2, 0.3), {}, contact_dynamics(0.1));
  EXPECT_EQ(slips.raw_sliding, 1);
  const Simulation rolls = simulate(disk_on_incline(0.1, 0.3), {}, contact_dynamics(0.1));
  EXPECT_EQ(rolls.raw_sliding, 0);
}

TEST(Simulate, FrictionlessDisksNeitherTurnNorCarryTangentialForces) {
  Scene scene;
  scene.disks = 12;
  scene.friction = {0, 0};
  const World world = build(scene);
  for (const Kind kind : {Kind::kContactDynamics, Kind::kStiff}) {
    const Simulation result = simulate(world, {}, options_of(kind, 20));
    for (const Disk& disk : result.packing.disks) EXPECT_EQ(disk.angle, 0);
    ASSERT_GT(result.packing.contact_count(), 0);
    for (const Contact& contact : result.packing.contacts) EXPECT_EQ(contact.T, 0);
  }
}

/// Bytes: positions, velocities and forces.
bool identical(const Simulation& p, const Simulation& q) {
  if (p.raw.contact_count() != q.raw.contact_count()) return false;
  for (int i = 0; i < p.raw.disk_count(); ++i) {
    const Disk& a = p.raw[DiskId(i)];
    const Disk& b = q.raw[DiskId(i)];
    if (a.position != b.position || a.velocity != b.velocity || a.angle != b.angle) return false;
  }
  return p.raw.simulated_forces().value() == q.raw.simulated_forces().value();
}

TEST(Simulate, ResumedRunIsIdenticalToAnUninterruptedOne) {
  Scene scene;
  scene.disks = 15;
  const World world = build(scene);
  for (const Kind kind : {Kind::kContactDynamics, Kind::kStiff, Kind::kPaper}) {
    SimulationOptions options = options_of(kind, 6);
    const Simulation whole = simulate(world, {}, options);

    const auto first = make_stepper(world, {}, options);
    const int steps = kind == Kind::kStiff ? 40000 : 500;
    const int stride = kind == Kind::kStiff ? 50 : 1;  // Of simulate().
    for (int i = 0; i < steps; i += stride) first->advance(stride);
    const Checkpoint checkpoint{first->world(), first->state(), first->report(), 0};
    const Simulation resumed = simulate(world, {}, options, {}, &checkpoint);
    EXPECT_TRUE(identical(whole, resumed)) << static_cast<int>(kind);
    EXPECT_EQ(whole.settled.time, resumed.settled.time);
  }
}

TEST(Simulate, StoppingHandsOverACheckpointAndThrows) {
  Scene scene;
  scene.disks = 60;
  Listener listener;
  int checkpoints = 0;
  listener.progress = [](const Progress&) { return false; };
  listener.on_checkpoint = [&](const Checkpoint& checkpoint) {
    ++checkpoints;
    EXPECT_GT(checkpoint.report.steps, 0);
  };
  const World world = build(scene);
  EXPECT_THROW(simulate(world, {}, contact_dynamics(1000), listener), Interrupted);
  EXPECT_EQ(checkpoints, 1);
}

TEST(Simulate, FramesComeAtTheirInterval) {
  Scene scene;
  scene.disks = 3;
  Listener listener;
  listener.frame_interval = 0.5;
  std::vector<double> times;
  listener.on_frame = [&](const Frame& frame) { times.push_back(frame.time); };
  SimulationOptions options = contact_dynamics(2.01);
  options.kinetic_energy = 0;
  simulate(build(scene), {}, options, listener);
  ASSERT_EQ(times.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(times[static_cast<std::size_t>(i)], 0.5 * i, 1e-9);
}

TEST(Simulate, UnstableTimeStepIsRefusedWithItsBound) {
  const World world = build(Scene{});
  SimulationOptions options = molecular_dynamics(options_of(MolecularPreset::kPaperOverlap), 1);
  options.molecular_dynamics.damping = Damping::kExplicit;
  options.molecular_dynamics.dt = 1e-4;
  ASSERT_TRUE(options.defect(world).has_value());
  EXPECT_THAT(*options.defect(world), HasSubstr("not stable"));
  EXPECT_THROW(simulate(world, {}, options), InputError);
  options.molecular_dynamics.dt = 6e-7;
  EXPECT_FALSE(options.defect(world).has_value());
}

TEST(Simulate, TimeLimitIsExplained) {
  World world = disk_on_incline(0.1, 0.3);
  const Simulation result = simulate(world, {}, contact_dynamics(1));
  EXPECT_EQ(result.settled.ending, Ending::kTimeLimit);
  EXPECT_THAT(result.settled.reason, HasSubstr("disk 0 moves fastest"));
}

}  // namespace
}  // namespace indet::sim
