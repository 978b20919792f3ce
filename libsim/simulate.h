#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libsim/explicit_stepper.h"
#include "libsim/implicit_stepper.h"
#include "libsim/polish.h"
#include "libsim/protocol.h"
#include "libsim/settle.h"

namespace indet::sim {

/// Contact dynamics: rigid disks. Times in units of √(r_max/g), forces in mg (world.h).
struct ContactDynamicsOptions {
  double dt = 1e-3;
  double tolerance = tolerance::kSweepChange;  ///< Largest change of a contact force in the last sweep.
  int max_sweeps = 100;                        ///< A step.
  /// Of a step in which no contact carries a force from the step before, as the first of cd2 (F = 0).
  int start_sweeps = 100000;
  RigidLaw law;
  double residual = tolerance::kRestForce;  ///< A state is static if its raw forces balance to this.
};

/// How damping forces enter a step of molecular dynamics.
enum class Damping {
  kAutomatic,  ///< Implicit where the contact of two disks is overdamped.
  kExplicit,   ///< From the velocities before the step; dt is bounded by stability.
  kImplicit,   ///< From the velocities after the step, springs too; any dt.
};

/// Molecular dynamics: springs with dashpots. k in mg/r_max, γ in mg/r_max √(r_max/g). The default is the
/// preset `paper` (molecular_preset.h).
struct MolecularDynamicsOptions {
  double k = 1.2e5;
  double gamma = 7.7e4;
  Damping damping = Damping::kAutomatic;
  double dt = 0;  ///< 0: half the stability bound (explicit), 1e-3 (implicit).
  double tolerance = tolerance::kFineSweepChange;  ///< Of the implicit damping: largest change of a contact
                                                   ///< force in the last sweep.
  int max_sweeps = 1000;
  /// A state is static if its elastic forces balance to this. Rounding of the positions alone leaves about
  /// 1e-7 where k = 1.2e6.
  double residual = tolerance::kRestSpringForce;
};

struct SimulationOptions {
  Simulator simulator = Simulator::kContactDynamics;
  ContactDynamicsOptions contact_dynamics;
  MolecularDynamicsOptions molecular_dynamics;
  double kinetic_energy = tolerance::kRestEnergy;  ///< Per disk, mg r_max: below it a state may be static.
  int calm_steps = 50;
  double time_limit = 0;  ///< > 0.
  PolishOptions polish = {};

  /// The reason why these options cannot be used for a world, if there is one (for example an unstable dt).
  std::optional<std::string> defect(const World& world) const;
};

/// What a simulation left.
struct Simulation {
  Packing packing;    ///< Contacts that transmit force, with the polished forces (raw ones if not balanced).
  Packing raw;        ///< Every contact of the last step, with its raw forces.
  Polished polished;  ///< Of `raw`.
  Settled settled;
  double dt = 0;  ///< That was used; units of time.
  bool implicit_damping = false;
  double mean_overlap = 0;  ///< Mean of −gap over the contacts of `packing`, gaps > 0 counting as 0; r_max.
  double largest_overlap = 0;  ///< r_max.
  int raw_sliding =
      0;  ///< Contacts of `raw` with R ≥ ε and μR − |T| < ε (tolerance::kSliding), as in the paper.
  double mean_force = 0;  ///< Mean R of `packing`, mg.
};

/// Lets a world come to rest. `contacts`: what the contacts remember (empty: nothing). Throws InputError with
/// the options' defect.
Simulation simulate(const World& start, const std::vector<ContactState>& contacts,
                    const SimulationOptions& options, const Listener& listener = {},
                    const Checkpoint* resume = nullptr);

/// How often `simulate` looks at the static criterion: every so many steps.
int stride_of(const SimulationOptions& options);

StopCriteria stop_criteria(const SimulationOptions& options);

/// The state that a stepper has come to, polished.
Simulation conclude(const Stepper& stepper, const Settled& settled, const SimulationOptions& options);

/// The stepper that `simulate` uses. Precondition: options.defect(world) is empty.
std::unique_ptr<Stepper> make_stepper(const World& world, const std::vector<ContactState>& contacts,
                                      const SimulationOptions& options);

/// 6 √(height/g), about twice the time in which a disk falls from that height; in units of time.
double default_time_limit(const World& world, double height);

}  // namespace indet::sim
