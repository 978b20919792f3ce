#include "libsim/perturb_sampling.h"

#include <gtest/gtest.h>

#include "libindet/base/error.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

Packing settled(int disks) {
  Scene scene;
  scene.disks = disks;
  scene.seed = 4;
  const World world = build(scene);
  return simulate(world, {}, contact_dynamics(default_time_limit(world, scene.resolved().height))).packing;
}

TEST(Perturb, AcceptedSamplesAreInThePolytopeAndSpreadOut) {
  const Packing packing = settled(40);
  const PerturbEnsemble ensemble = perturb_and_resolve(packing, {.samples = 30, .threads = 2});
  EXPECT_GE(ensemble.accepted, 25);
  for (const PerturbSample& sample : ensemble.samples) {
    if (!sample.accepted) continue;
    EXPECT_LE(balance_residual(packing, sample.forces), 1e-9);
    EXPECT_LE(cone_violation(packing, sample.forces), 1e-9);
  }
  EXPECT_GT(ensemble.r, 0.5);
}

TEST(Perturb, ResultsDoNotDependOnTheNumberOfThreads) {
  const Packing packing = settled(40);
  const auto draw = [&](int threads) {
    return perturb_and_resolve(packing, {.samples = 24, .chains = 6, .seed = 9, .threads = threads});
  };
  const PerturbEnsemble one = draw(1);
  // Chains that share a worker share its solvers, whose contacts slide and open differently from sample to
  // sample.
  for (const int threads : {2, 3, 8}) {
    const PerturbEnsemble many = draw(threads);
    EXPECT_EQ(one.r, many.r);
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
      EXPECT_EQ(one.samples[i].forces, many.samples[i].forces);
    }
  }
}

TEST(Perturb, DeterminedForcesHaveRadiusZero) {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {0, 1});
  const Packing packing = packing_of(world, {{.a = 0, .b = -1, .mu = 0.3, .R = world.mass[0], .T = 0}});
  const PerturbEnsemble ensemble = perturb_and_resolve(packing, {.samples = 10});
  EXPECT_EQ(ensemble.accepted, 10);
  EXPECT_LT(ensemble.r, 1e-12);
}

TEST(Perturb, UnknownForcesAreRefused) {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {0, 1});
  Packing packing = packing_of(world, {{.a = 0, .b = -1, .mu = 0.3}});
  packing.contacts[0].R = std::nan("");
  EXPECT_THROW(perturb_and_resolve(packing, {}), InputError);
}

}  // namespace
}  // namespace indet::sim
