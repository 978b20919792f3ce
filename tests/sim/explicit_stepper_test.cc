#include "libsim/explicit_stepper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

TEST(SpringLaw, NormalForceIsTheSlopeOfItsEnergy) {
  const SpringLaw law{.k = 3e4, .gamma = 0};
  const auto energy = [&](double gap) { return gap < 0 ? 0.5 * law.k * gap * gap : 0; };
  for (const double gap : {-0.3, -0.01, 0.2}) {
    const double h = 1e-6;
    EXPECT_NEAR(law.normal_force(gap, 0), -(energy(gap + h) - energy(gap - h)) / (2 * h),
                1e-5 * law.k * h + 1e-4);
  }
}

TEST(SpringLaw, SlidingSpringStaysAtItsGreatestStretch) {
  const SpringLaw law{.k = 100, .gamma = 5};
  const auto force = law.tangential_force(0.02, 1, 0.6);
  EXPECT_TRUE(force.sliding);
  EXPECT_EQ(force.T, -0.6);
  EXPECT_DOUBLE_EQ(-law.k * force.spring, force.T);
  const auto stuck = law.tangential_force(0.001, 0.01, 0.6);
  EXPECT_FALSE(stuck.sliding);
  EXPECT_DOUBLE_EQ(stuck.T, -100 * 0.001 - 5 * 0.01);
}

/// A disk that oscillates on the floor without leaving it, undamped: largest error of the energy at whole
/// steps, with v_n = (v_{n−1/2} + v_{n+1/2})/2.
double energy_error(double dt) {
  World world = disk_on_incline(0, 0);
  const SpringLaw law{.k = 1e4, .gamma = 0};
  world.y[0] = 1 - 1.5 * world.mass[0] / law.k;
  ExplicitStepper stepper(world, {}, law, dt);
  double first = 0;
  double worst = 0;
  double v_before = 0;
  for (int i = 0; i < 400; ++i) {
    stepper.advance(1);
    const double v = (v_before + stepper.world().vy[0]) / 2;
    if (i > 0) {
      // Position of the previous step: x_n = x_{n+1} − dt v_{n+1/2}.
      const double y = stepper.world().y[0] - dt * stepper.world().vy[0];
      const double overlap = 1 - y;
      const double energy = 0.5 * world.mass[0] * v * v + 0.5 * law.k * overlap * overlap + world.mass[0] * y;
      if (i == 1) first = energy;
      worst = std::max(worst, std::abs(energy - first));
    }
    v_before = stepper.world().vy[0];
  }
  return worst;
}

TEST(ExplicitStepper, EnergyErrorIsOfSecondOrderInTheTimeStep) {
  const double coarse = energy_error(1e-3);
  const double fine = energy_error(5e-4);
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(coarse / fine, 4, 0.6);
}

/// Restitution of a linear spring and dashpot whose force never pulls (Schwager and Pöschel, Granular Matter
/// 9, 465 (2007)): ln e = −β/ω (π − arctan(2βω/(ω² − β²))) for β < ω_0/√2.
TEST(ExplicitStepper, CollisionHasTheRestitutionOfItsDamping) {
  World world = empty_world(0);
  world.gravity = {0, 0};
  world.named_force_unit = 1;
  add_disk(world, {0, 0}, 1, {1, 0});
  add_disk(world, {2.1, 0}, 1, {-1, 0});
  const double reduced = world.mass[0] / 2;
  const SpringLaw law{.k = 1e5, .gamma = 250};
  const double omega0 = std::sqrt(law.k / reduced);
  const double beta = law.gamma / (2 * reduced);
  const double omega = std::sqrt(omega0 * omega0 - beta * beta);
  ASSERT_LT(beta, omega0 / std::sqrt(2.0));
  const double expected = std::exp(
      -beta / omega * (std::numbers::pi - std::atan(2 * beta * omega / (omega * omega - beta * beta))));
  ExplicitStepper stepper(world, {}, law, 2e-6);
  stepper.advance(200000);
  EXPECT_NEAR((stepper.world().vx[1] - stepper.world().vx[0]) / 2, expected, 2e-3);
}

TEST(ExplicitStepper, StabilityBoundHolds) {
  Scene scene;
  scene.disks = 12;
  scene.width = 2.2 * 3;
  scene.columns = 3;
  const World world = build(scene);
  const Units units = world.units();
  const SpringLaw law{.k = 1e5 * units.stiffness(), .gamma = 2e4 * units.damping()};
  const double dt = largest_explicit_step(world, law);
  ExplicitStepper stable(world, {}, law, 0.95 * dt);
  stable.advance(static_cast<int>(20 / dt));
  EXPECT_LT(imbalance_of(stable.world(), stable.forces()).worst(), 1e-3);
  // The bound allows for contacts on all sides of every disk, which this pile does not have. Contacts that
  // open keep an unstable pile from flying apart, but not from rattling.
  ExplicitStepper unstable(world, {}, law, 8 * dt);
  unstable.advance(static_cast<int>(3 / dt));
  EXPECT_GT(imbalance_of(unstable.world(), unstable.forces()).worst(), 0.1);
}

TEST(ExplicitStepper, LoadsAccelerate) {
  World world = empty_world();
  add_disk(world, {0, 0});
  world.load_x[0] = 2;
  world.load_torque[0] = 3;
  ExplicitStepper stepper(world, {}, {.k = 1e4, .gamma = 0}, 1e-3);
  stepper.advance(1000);
  EXPECT_NEAR(stepper.world().vx[0], 2 / world.mass[0], 1e-12);
  EXPECT_NEAR(stepper.world().vy[0], -1, 1e-12);
  EXPECT_NEAR(stepper.world().omega[0], 3 / world.inertia[0], 1e-12);
  EXPECT_NEAR(stepper.world().angle[0], 1.5 / world.inertia[0], 2e-3);
}

TEST(ExplicitStepper, SpringsSurviveNewNeighbourLists) {
  // A sliding disk runs far enough that its lists are made anew; its friction must not notice.
  World world = disk_on_incline(0, 0.3);
  world.vx[0] = 3;
  const World after = run(world, molecular_dynamics(options_of(MolecularPreset::kStiff), 1), 2);
  EXPECT_NEAR(after.vx[0], 3 - 0.3 * 2, 2e-3);
}

TEST(ExplicitStepper, ContinuesFromItsStateToTheSameBytes) {
  // New lists, with another skin, at another time: sums must come out the same.
  Scene scene;
  scene.disks = 21;
  scene.columns = 4;
  const World start = build(scene);
  const SimulationOptions options = molecular_dynamics(options_of(MolecularPreset::kStiff), 1);
  const auto whole = make_stepper(start, {}, options);
  const auto half = make_stepper(start, {}, options);
  half->advance(100000);
  const auto rest = make_stepper(half->world(), half->state(), options);
  whole->advance(100000);
  whole->advance(30000);
  rest->advance(30000);
  EXPECT_EQ(whole->world().x, rest->world().x);
  EXPECT_EQ(whole->world().vy, rest->world().vy);
  EXPECT_EQ(whole->world().angle, rest->world().angle);
  EXPECT_GT(whole->state().size(), 5u);
  EXPECT_EQ(whole->state(), rest->state());
}

}  // namespace
}  // namespace indet::sim
