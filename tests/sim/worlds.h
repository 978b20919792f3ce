#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <ostream>

#include "libsim/molecular_preset.h"
#include "libsim/scene.h"
#include "libsim/simulate.h"

namespace indet::sim {

/// Disks of density 1 (mass π r², inertia m r²/2) and no walls; g = 1 downwards unless changed.
inline World empty_world(double mu = 0.3) {
  World world;
  world.gravity = {0, -1};
  world.friction = {mu, mu};
  return world;
}

inline void add_disk(World& world, Vector2 position, double radius = 1, Vector2 velocity = {0, 0},
                     double omega = 0) {
  const double mass = std::numbers::pi * radius * radius;
  world.add(Disk{.id = world.size(),
                 .position = position,
                 .radius = radius,
                 .mass = mass,
                 .inertia = mass * radius * radius / 2,
                 .velocity = velocity,
                 .angular_velocity = omega});
}

inline void add_wall(World& world, Vector2 point, Vector2 normal) {
  world.walls.push_back(
      Wall{.id = static_cast<int>(world.walls.size()), .point = point, .normal = normal, .name = ""});
}

/// One disk on the floor y = 0, with gravity tilted by `slope`: an incline that leads towards +x.
///
///        ___
///       /   \  → x      g = (sin slope, −cos slope)
///       \___/
///     ===========
inline World disk_on_incline(double slope, double mu) {
  World world = empty_world(mu);
  world.gravity = {std::sin(slope), -std::cos(slope)};
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {0, 1});
  return world;
}

inline SimulationOptions contact_dynamics(double time_limit) {
  SimulationOptions options;
  options.time_limit = time_limit;
  return options;
}

inline SimulationOptions molecular_dynamics(const MolecularDynamicsOptions& preset, double time_limit) {
  SimulationOptions options;
  options.simulator = Simulator::kMolecularDynamics;
  options.molecular_dynamics = preset;
  options.time_limit = time_limit;
  return options;
}

/// The methods that tests of both simulators run.
enum class Kind { kContactDynamics, kStiff, kPaper };

inline const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kContactDynamics:
      return "ContactDynamics";
    case Kind::kStiff:
      return "StiffSprings";
    case Kind::kPaper:
      return "PaperSprings";
  }
  return "";
}

inline void PrintTo(Kind kind, std::ostream* stream) { *stream << name_of(kind); }

inline SimulationOptions options_of(Kind kind, double time_limit) {
  if (kind == Kind::kContactDynamics) return contact_dynamics(time_limit);
  return molecular_dynamics(
      kind == Kind::kStiff ? options_of(MolecularPreset::kStiff) : options_of(MolecularPreset::kPaperOverlap),
      time_limit);
}

/// Runs a world for `time` (units of time), whether it comes to rest or not.
inline World run(const World& world, const SimulationOptions& options, double time) {
  const auto stepper = make_stepper(world, {}, options);
  stepper->advance(static_cast<int>(std::lround(time * world.units().time / stepper->dt())));
  return stepper->world();
}

}  // namespace indet::sim
