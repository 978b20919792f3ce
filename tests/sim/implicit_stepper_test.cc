#include "libsim/implicit_stepper.h"

#include <gtest/gtest.h>

#include "libindet/base/random.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

/// Two disks that meet on the x axis, without gravity; u_t = transverse + s_a + s_b.
World collision(double approach, double transverse, double mu) {
  World world = empty_world(mu);
  world.gravity = {0, 0};
  world.named_force_unit = 1;
  add_disk(world, {0, 0}, 1, {0, 0});
  add_disk(world, {2.02, 0}, 0.9, {-approach, transverse});
  return world;
}

/// n̂ points from b = 1 to a = 0, that is along −x, and t̂ = (0, 1).
double normal_velocity(const World& w) { return -(w.vx[0] - w.vx[1]); }
double tangential_velocity(const World& w) {
  return w.vy[0] - w.vy[1] + w.radius[0] * w.omega[0] + w.radius[1] * w.omega[1];
}

class Restitution : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(All, Restitution, ::testing::Values(0.0, 0.3, 0.8, 1.0));

TEST_P(Restitution, NormalVelocityIsReversedByThatFactor) {
  World world = collision(1, 0, 0);
  SimulationOptions options = contact_dynamics(1);
  options.contact_dynamics.law.restitution_n = GetParam();
  const World after = run(world, options, 1);
  EXPECT_NEAR(normal_velocity(after), -GetParam() * normal_velocity(world), 1e-12);
}

TEST_P(Restitution, TangentialVelocityIsReversedByThatFactorWhereFrictionSuffices) {
  World world = collision(1, 0.2, 10);
  SimulationOptions options = contact_dynamics(1);
  options.contact_dynamics.law.restitution_n = 0.5;
  options.contact_dynamics.law.restitution_t = GetParam();
  const World after = run(world, options, 1);
  EXPECT_NEAR(tangential_velocity(after), -GetParam() * tangential_velocity(world), 1e-2);
}

TEST(ImplicitStepper, MomentumIsConservedWithoutWallsAndGravity) {
  World world = empty_world(0.4);
  world.gravity = {0, 0};
  world.named_force_unit = 1;
  Random random(5);
  for (int i = 0; i < 25; ++i) {
    add_disk(world, {2.3 * (i % 5), 2.3 * (i / 5)}, random.uniform(0.7, 1),
             {random.uniform(-1, 1), random.uniform(-1, 1)}, random.uniform(-1, 1));
  }
  const auto momentum = [](const World& w) {
    Vector2 sum{0, 0};
    for (int i = 0; i < w.size(); ++i) sum += w.mass[i] * Vector2(w.vx[i], w.vy[i]);
    return sum;
  };
  for (const SimulationOptions& options :
       {contact_dynamics(1), molecular_dynamics(options_of(MolecularPreset::kStiff), 1)}) {
    const World after = run(world, options, 2);
    EXPECT_LT(after.kinetic_energy(), world.kinetic_energy());
    EXPECT_LT((momentum(after) - momentum(world)).norm(), 1e-11);
  }
}

/// Every contact of a random pile of contacts fulfils its conditions.
TEST(ContactSolver, SolutionFulfilsTheContactConditions) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<SolverBody> bodies(12);
    for (SolverBody& body : bodies)
      body = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    std::vector<SolverContact> contacts;
    for (int i = 0; i < 16; ++i) {
      SolverContact c;
      c.a = static_cast<int>(random.below(12));
      c.b = static_cast<int>((static_cast<std::uint64_t>(c.a) + 1 + random.below(11)) % 12);
      const double angle = random.uniform(0, 6.283);
      c.nx = std::cos(angle);
      c.ny = std::sin(angle);
      c.mu = i % 4 == 0 ? 0 : 0.3;
      c.bias_n = random.uniform(-0.1, 0.1);
      c.compliance = i % 3 == 0 ? 0.2 : 0;
      c.inverse_mass_a = 1;
      c.inverse_mass_b = 0.5;
      c.inverse_spin_a = 2;
      c.inverse_spin_b = 1;
      c.prepare();
      contacts.push_back(c);
    }
    // Masses belong to bodies; here each contact sees its own, which the conditions do not care about.
    const SweepReport report =
        ContactSolver().solve(contacts, bodies, {.max_sweeps = 200000, .tolerance = 1e-14});
    ASSERT_TRUE(report.converged) << "seed " << seed;
    for (const SolverContact& c : contacts) {
      const SolverBody& a = bodies[static_cast<std::size_t>(c.a)];
      const SolverBody& b = bodies[static_cast<std::size_t>(c.b)];
      const double u_n = c.nx * (a.vx - b.vx) + c.ny * (a.vy - b.vy) + c.compliance * c.p_n + c.bias_n;
      const double u_t =
          c.ny * (a.vx - b.vx) - c.nx * (a.vy - b.vy) + a.s + b.s + c.compliance * c.p_t + c.bias_t;
      EXPECT_GE(c.p_n, 0);
      EXPECT_GE(u_n, -1e-10);
      EXPECT_NEAR(c.p_n * u_n, 0, 1e-10);
      EXPECT_LE(std::abs(c.p_t), c.mu * c.p_n);
      if (std::abs(c.p_t) < c.mu * c.p_n) {
        EXPECT_NEAR(u_t, 0, 1e-10);
      } else {
        EXPECT_LE(u_t * c.p_t, 1e-10);
      }
    }
  }
}

TEST(ImplicitStepper, ImplicitSpringsMatchExplicitOnesWhereBothAreStable) {
  // A disk dropped on two others: overdamped springs, the paper's damping.
  World world = empty_world(0.3);
  add_wall(world, {0, 0}, {0, 1});
  add_wall(world, {0, 0}, {1, 0});
  add_wall(world, {4.02, 0}, {-1, 0});
  add_disk(world, {1, 1});
  add_disk(world, {3.01, 1});
  add_disk(world, {2.2, 2.75}, 0.9);
  SimulationOptions explicit_damping = molecular_dynamics(options_of(MolecularPreset::kPaperOverlap), 1);
  explicit_damping.molecular_dynamics.damping = Damping::kExplicit;
  const World exact = run(world, explicit_damping, 1);
  const auto error = [&](double dt) {
    const Units units = world.units();
    const SpringLaw law{.k = 1.2e6 * units.stiffness(), .gamma = 7.7e4 * units.damping()};
    ImplicitStepper stepper(world, {},
                            {.dt = dt, .springs = law, .rigid = {}, .max_sweeps = 10000, .tolerance = 1e-9});
    stepper.advance(static_cast<int>(std::lround(units.time / dt)));
    const World& w = stepper.world();
    double worst = 0;
    for (int i = 0; i < 3; ++i) worst = std::max(worst, std::hypot(w.x[i] - exact.x[i], w.y[i] - exact.y[i]));
    return worst;
  };
  const double coarse = error(1e-3);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_LT(error(2e-5), 0.6 * coarse);
}

}  // namespace
}  // namespace indet::sim
