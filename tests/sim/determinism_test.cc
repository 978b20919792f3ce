#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "tests/sim/worlds.h"

/// The same seed gives the same bytes in every build: these digests hold for debug, release and sanitized
/// builds, on any machine with IEEE doubles. They change only with the physics or the order of its sums.
namespace indet::sim {
namespace {

/// FNV-1a over the bits of all positions, angles and velocities, and of the forces.
std::uint64_t digest(const Stepper& stepper) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
  };
  const World& world = stepper.world();
  for (const std::vector<double>* values :
       {&world.x, &world.y, &world.angle, &world.vx, &world.vy, &world.omega}) {
    for (const double value : *values) add(value);
  }
  for (const ContactState& contact : stepper.forces()) {
    add(contact.R);
    add(contact.T);
  }
  return hash;
}

/// 30 disks that have fallen for `steps` steps.
std::uint64_t digest_after(int steps, const SimulationOptions& options) {
  Scene scene;
  scene.disks = 30;
  const auto stepper = make_stepper(build(scene), {}, options);
  stepper->advance(steps);
  return digest(*stepper);
}

TEST(Determinism, ContactDynamics) {
  EXPECT_EQ(digest_after(1000, contact_dynamics(1)), 4967430432341607452u);
}

TEST(Determinism, ExplicitMolecularDynamics) {
  EXPECT_EQ(digest_after(150000, molecular_dynamics(options_of(MolecularPreset::kStiff), 1)),
            17931077677174720669u);
}

TEST(Determinism, ImplicitMolecularDynamics) {
  EXPECT_EQ(digest_after(4000, molecular_dynamics(options_of(MolecularPreset::kPaperOverlap), 1)),
            12141414561585980964u);
}

}  // namespace
}  // namespace indet::sim
