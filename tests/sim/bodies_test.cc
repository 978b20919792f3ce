#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libsim/perturb_sampling.h"
#include "libsim/static_solver.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

enum class Simulators { kRigid, kExplicit, kImplicit };

SimulationOptions options_for(Simulators kind, double time_limit) {
  if (kind == Simulators::kRigid) return contact_dynamics(time_limit);
  return molecular_dynamics(
      options_of(kind == Simulators::kExplicit ? MolecularPreset::kStiff : MolecularPreset::kPaperOverlap),
      time_limit);
}

/// Fixed disks and levers, with every simulator: explicit and implicit springs, and rigid disks.
class Bodies : public ::testing::TestWithParam<Simulators> {};

INSTANTIATE_TEST_SUITE_P(All, Bodies,
                         ::testing::Values(Simulators::kRigid, Simulators::kExplicit, Simulators::kImplicit));

void add_fixed(World& world, Vector2 position, double radius) {
  world.add(Disk{.id = world.size(),
                 .position = position,
                 .radius = radius,
                 .velocity = {1, 1},
                 .load = {1, 2, 3},
                 .fixed = true});
}

/// A disk falls between two fixed ones, which overlap each other and a wall without consequence.
///
///        ( )       contacts ±φ from the vertical: a groove (zoo::wedge), |T| ≤ μR,
///      (1) (2)     R ∈ [1/2 / (cos φ + μ sin φ), 1/2 / (cos φ − μ sin φ)] mg
TEST_P(Bodies, ADiskComesToRestOnTwoFixedOnes) {
  const double phi = std::numbers::pi / 8;
  World world = empty_world(0.3);
  add_wall(world, {0, -0.5}, {0, 1});
  for (const double side : {-1.0, 1.0}) add_fixed(world, {side * 1.9 * std::sin(phi), 0}, 0.9);
  add_disk(world, {0, 1.9 * std::cos(phi) + 0.3});
  const World before = world;
  const Simulation result = simulate(world, {}, options_for(GetParam(), 30));
  EXPECT_EQ(result.settled.ending, Ending::kStatic) << result.settled.reason;
  EXPECT_TRUE(result.polished.balanced) << result.polished.reason;
  const Packing& packing = result.packing;
  ASSERT_EQ(packing.contact_count(), 2);
  EXPECT_DOUBLE_EQ(packing.force_unit(), world.mass[2]) << "fixed disks weigh nothing";
  for (const int i : {0, 1}) {
    EXPECT_TRUE(packing[DiskId(i)].fixed);
    EXPECT_EQ(packing[DiskId(i)].position, Vector2(before.x[i], before.y[i]));
    EXPECT_EQ(packing[DiskId(i)].velocity, Vector2(0, 0));
  }
  for (const Contact& contact : packing.contacts) {
    const double R = contact.R / world.mass[2];
    EXPECT_GE(R, 0.5 / (std::cos(phi) + 0.3 * std::sin(phi)) - 1e-4);
    EXPECT_LE(R, 0.5 / (std::cos(phi) - 0.3 * std::sin(phi)) + 1e-4);
  }
}

/// Rolling on a lever l, v + l ω = 0 and I dω/dt = l T: a disk goes down an incline with
/// a = g sin θ / (1 + I/(m l²)).
TEST_P(Bodies, ADiskRollsOnItsLever) {
  const double slope = 0.2;
  for (const double lever : {0.8, 1.1}) {
    World world = disk_on_incline(slope, 0.8);
    world.levers[{0, -1}] = {lever, kNaN};
    const World after = run(world, options_for(GetParam(), 1), 2);
    EXPECT_NEAR(after.vx[0], 2 * std::sin(slope) / (1 + 0.5 / (lever * lever)), 5e-3);
    EXPECT_NEAR(after.vx[0] + lever * after.omega[0], 0, 5e-3);
  }
}

/// A pyramid between two walls; at rest the torques of its tangential forces, with the levers, cancel on each
/// disk.
TEST_P(Bodies, APileWithLeversComesToRest) {
  World world = empty_world(0.5);
  add_wall(world, {0, 0}, {0, 1});
  add_wall(world, {-2.1, 0}, {1, 0});
  add_wall(world, {2.1, 0}, {-1, 0});
  add_disk(world, {-1.1, 1});
  add_disk(world, {1.1, 1});
  add_disk(world, {0, 1 + std::sqrt(4 - 1.21)});
  world.levers = {{{0, 2}, {0.9, 0.95}}, {{1, 2}, {1.05, 0.8}}, {{0, -1}, {0.97, kNaN}}};
  const Simulation result = simulate(world, {}, options_for(GetParam(), 40));
  EXPECT_EQ(result.settled.ending, Ending::kStatic) << result.settled.reason;
  EXPECT_TRUE(result.polished.balanced) << result.polished.reason;
  double torque[3] = {0, 0, 0};
  double largest = 0;
  int with_levers = 0;
  for (const Contact& contact : result.packing.contacts) {
    const auto given = world.levers.find({contact.a.value(), contact.b.code()});
    const bool is_given = given != world.levers.end();
    with_levers += is_given ? 1 : 0;
    const double lever_a = is_given ? given->second.a : 1;
    const double lever_b = is_given ? given->second.b : 1;
    torque[contact.a.value()] += lever_a * contact.T;
    if (!contact.b.is_wall()) torque[contact.b.disk_id().value()] += lever_b * contact.T;
    largest = std::max(largest, std::abs(contact.T));
    EXPECT_EQ(result.packing.lever_a(contact), lever_a);
  }
  EXPECT_EQ(with_levers, 3);
  EXPECT_GT(largest, 0.01 * world.mass[0]) << "levers must matter";
  for (const double sum : torque) EXPECT_NEAR(sum / world.mass[0], 0, 1e-11);
}

/// A settled packing with levers of the same share α of the radius everywhere keeps its balance: its torque
/// equations are only scaled. Then every solver must leave its forces alone.
Packing with_equal_arms() {
  Scene scene;
  scene.disks = 30;
  scene.seed = 3;
  const World world = build(scene);
  Packing packing =
      simulate(world, {}, contact_dynamics(default_time_limit(world, scene.resolved().height))).packing;
  for (Contact& contact : packing.contacts) {
    contact.lever_a = 0.875 * packing[contact.a].radius;
    if (!contact.b.is_wall()) contact.lever_b = 0.875 * packing[contact.b.disk_id()].radius;
  }
  return packing;
}

TEST(Levers, OfOneShareLeaveBalancedForcesAlone) {
  const Packing packing = with_equal_arms();
  const Eigen::VectorXd forces = packing.simulated_forces().value();
  EXPECT_LT(balance_residual(packing, forces), 1e-11);
  const Polished polished = polish(packing, forces);
  EXPECT_TRUE(polished.balanced);
  EXPECT_LT(polished.distance, 1e-10);
  const StaticForces solved = solve_statics(packing, forces);
  EXPECT_LT((solved.forces - forces).norm() / packing.force_unit(), 1e-8);
  const Friction friction = friction_of(packing);
  const Simulation again = simulate(world_of(packing, friction), {}, contact_dynamics(3));
  EXPECT_TRUE(again.polished.balanced) << again.polished.reason;
  EXPECT_TRUE(again.packing.has_levers());
}

TEST(Levers, OfChanceAreBalancedByThePolishAndByPerturbation) {
  Packing packing = with_equal_arms();
  Random random(8);
  for (Contact& contact : packing.contacts) {
    contact.lever_a *= random.uniform(0.99, 1);
    if (!contact.b.is_wall()) contact.lever_b *= random.uniform(0.99, 1);
  }
  // The lowest disks become a rough base: whatever is below them has no part in the balance any more.
  for (Disk& disk : packing.disks) disk.fixed = disk.position.y() < 1.2 * packing.max_radius();
  std::erase_if(packing.contacts, [&](const Contact& contact) {
    return !packing.has_equations(contact.a) && !packing.has_equations(contact.b);
  });
  const int fixed = packing.fixed_disk_count();
  ASSERT_GE(fixed, 3);
  const Polished polished = polish(packing, packing.simulated_forces().value(), {.sliding = 1e-4});
  ASSERT_TRUE(polished.balanced) << polished.reason;
  for (int i = 0; i < packing.contact_count(); ++i) {
    packing.contacts[static_cast<std::size_t>(i)].R = polished.forces[2 * i];
    packing.contacts[static_cast<std::size_t>(i)].T = polished.forces[2 * i + 1];
  }
  const PerturbEnsemble ensemble = perturb_and_resolve(packing, {.samples = 12, .threads = 2});
  EXPECT_GE(ensemble.accepted, 10);
  for (const PerturbSample& sample : ensemble.samples) {
    if (!sample.accepted) continue;
    // Balance, contact by contact.
    Eigen::MatrixXd sum(packing.disk_count(), 3);
    for (int i = 0; i < packing.disk_count(); ++i) {
      const Disk& disk = packing[DiskId(i)];
      sum.row(i) << disk.mass * packing.gravity.x(), disk.mass * packing.gravity.y(), 0;
    }
    for (int i = 0; i < packing.contact_count(); ++i) {
      const Contact& c = packing[ContactId(i)];
      const Vector2 force = sample.forces[2 * i] * c.normal + sample.forces[2 * i + 1] * c.tangent();
      sum.row(c.a.value()) += Vector3(force.x(), force.y(), c.lever_a * sample.forces[2 * i + 1]).transpose();
      if (c.b.is_wall()) continue;
      sum.row(c.b.disk_id().value()) +=
          Vector3(-force.x(), -force.y(), c.lever_b * sample.forces[2 * i + 1]).transpose();
    }
    for (int i = 0; i < packing.disk_count(); ++i) {
      if (packing[DiskId(i)].fixed) continue;
      EXPECT_LT(sum.row(i).lpNorm<Eigen::Infinity>() / packing.force_unit(), 1e-8);
    }
  }
}

TEST(LoadedWalls, AreRefusedWithWhatTakesThem) {
  Packing packing = with_equal_arms();
  packing.walls[0].load_n = 1;
  packing.walls[0].name = "piston";
  const auto refuses = testing::ThrowsMessage<InputError>(
      testing::AllOf(testing::HasSubstr("wall piston is loaded"), testing::HasSubstr("--method uniform")));
  EXPECT_THAT([&] { perturb_and_resolve(packing, {}); }, refuses);
  EXPECT_THAT([&] { polish(packing, packing.simulated_forces().value()); }, refuses);
  EXPECT_THAT([&] { solve_statics(packing, packing.simulated_forces().value()); }, refuses);
  EXPECT_THAT([&] { world_of(packing, {}); }, refuses);
}

TEST(FixedDisks, CannotBeSimulatedAlone) {
  World world = empty_world();
  add_fixed(world, {0, 0}, 1);
  EXPECT_NE(contact_dynamics(1).defect(world).value_or("").find("no disks that can move"), std::string::npos);
}

}  // namespace
}  // namespace indet::sim
