#include "libsim/polish.h"

#include <gtest/gtest.h>

#include "libindet/base/random.h"
#include "libsim/static_solver.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

Simulation settled(int disks, std::uint64_t seed) {
  Scene scene;
  scene.disks = disks;
  scene.seed = seed;
  const World world = build(scene);
  return simulate(world, {}, contact_dynamics(default_time_limit(world, scene.resolved().height)));
}

TEST(Polish, MovesNearlyBalancedForcesOntoThePolytope) {
  const Packing packing = settled(30, 1).packing;
  const Eigen::VectorXd balanced = packing.simulated_forces().value();
  const double unit = packing.force_unit();
  Eigen::VectorXd raw = balanced;
  Random random(2);
  for (double& force : raw) force += 1e-5 * unit * random.uniform(-1, 1);
  const Polished result = polish(packing, raw, {.sliding = 1e-4});
  EXPECT_TRUE(result.balanced) << result.reason;
  EXPECT_LE(result.residual, 1e-12);
  EXPECT_LE(balance_residual(packing, result.forces), 1e-12);
  EXPECT_EQ(cone_violation(packing, result.forces), 0);
  // No state of the polytope is nearer than `distance` by much: the unperturbed one is in it.
  EXPECT_LE(result.distance, 3 * (raw - balanced).norm() / unit);
  EXPECT_NEAR(result.distance, (result.forces - raw).norm() / unit, 1e-13);
}

TEST(Polish, LeavesBalancedForcesAlone) {
  const Packing packing = settled(30, 2).packing;
  const Polished result = polish(packing, packing.simulated_forces().value());
  EXPECT_TRUE(result.balanced);
  EXPECT_LT(result.distance, 1e-11);
}

TEST(Polish, KeepsSlidingContactsAtTheLimit) {
  // A disk in a steep notch: with one free force, a raw state at the limit has one balanced neighbour there.
  const double phi = 0.6;
  World world = empty_world(0.3);
  add_wall(world, {0, 0}, {std::sin(phi), std::cos(phi)});
  add_wall(world, {0, 0}, {-std::sin(phi), std::cos(phi)});
  add_disk(world, {0, 1 / std::cos(phi)});
  std::vector<ContactState> contacts(2);
  for (int w = 0; w < 2; ++w) contacts[static_cast<std::size_t>(w)] = {.a = 0, .b = -w - 1, .mu = 0.3};
  const Packing packing = packing_of(world, contacts);
  // Vertical balance with T = ±μR pushing the disk up on both sides: 2R (cos φ + μ sin φ) = mg.
  const double t = 1 / (2 * (std::cos(phi) + 0.3 * std::sin(phi)));
  Eigen::VectorXd raw(4);
  raw << t, -0.3 * t, t, 0.3 * t;
  raw *= world.mass[0] * (1 + 1e-4);
  const Polished result = polish(packing, raw);
  ASSERT_TRUE(result.balanced) << result.reason;
  EXPECT_EQ(result.sliding, 2);
  EXPECT_DOUBLE_EQ(std::abs(result.forces[1]), 0.3 * result.forces[0]);
}

TEST(Polish, SaysSoWhereNothingCanBalance) {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {0, 1});
  add_disk(world, {5, 7});
  const Packing packing = packing_of(world, {{.a = 0, .b = -1, .mu = 0.3, .R = 3, .T = 0}});
  const Polished result = polish(packing, packing.simulated_forces().value());
  EXPECT_FALSE(result.balanced);
  EXPECT_NEAR(result.residual, 1, 1e-9);
  EXPECT_NE(result.reason, "");
}

TEST(StaticSolver, FindsTheWeightOfATower) {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  std::vector<ContactState> contacts{{.a = 0, .b = -1, .mu = 0.3}};
  for (int i = 0; i < 5; ++i) add_disk(world, {0, 2.0 * i + 1});
  for (int i = 0; i + 1 < 5; ++i) contacts.push_back({.a = i, .b = i + 1, .mu = 0.3});
  const Packing packing = packing_of(world, contacts);
  const StaticForces result = solve_statics(packing, Eigen::VectorXd::Zero(10), {.tolerance = 1e-13});
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.residual, 1e-10);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(result.forces[2 * i] / world.mass[0], i == 0 ? 5 : 5 - i, 1e-9);
    EXPECT_NEAR(result.forces[2 * i + 1], 0, 1e-9);
  }
}

TEST(StaticSolver, StartingFromASolutionItStaysThere) {
  const Packing packing = settled(30, 3).packing;
  const Eigen::VectorXd start = packing.simulated_forces().value();
  const StaticForces result = solve_statics(packing, start);
  EXPECT_TRUE(result.converged);
  EXPECT_LT((result.forces - start).norm() / packing.force_unit(), 1e-9);
}

}  // namespace
}  // namespace indet::sim
