#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/base/tolerances.h"
#include "libsim/stepper.h"

namespace indet::sim {

/// When a run ends. Energies, forces and times in the world's units (world.h).
struct StopCriteria {
  /// Static: for more than `calm_steps` steps, the kinetic energy per disk stays below `kinetic_energy`, and
  /// the forces balance to `residual` on every disk.
  double kinetic_energy = tolerance::kRestEnergy;
  int calm_steps = 50;
  double residual = tolerance::kRestForce;
  double time_limit = 0;  ///< Simulated time.
};

enum class Ending {
  kStatic,     ///< The static criterion held.
  kTimeLimit,  ///< The time limit came first.
};

/// One state on the way, for trajectories.
struct Frame {
  double time = 0;  ///< Units of time (world.h).
  std::vector<double> x, y, angle;
  std::vector<double> vx, vy, omega;
  std::vector<ContactState> contacts;
};

Frame frame_of(const Stepper& stepper, double time);

/// A run that can be continued: with the same options it goes on as if it had never stopped, to the last bit.
struct Checkpoint {
  World world;
  std::vector<ContactState> contacts;
  StepperReport report;
  int calm_steps = 0;  ///< Steps for which the static criterion has held.
};

/// Of run time, between two reports of progress.
inline constexpr double kProgressSeconds = 0.1;

/// What a caller wants to hear while a run goes on.
struct Listener {
  ProgressCallback progress = {};
  double frame_interval = 0;  ///< Simulated time between frames; 0: none. Rounded to whole checks.
  std::function<void(const Frame&)> on_frame = {};
  double checkpoint_seconds = 0;  ///< Wall-clock time between checkpoints; 0: none but at an interruption.
  std::function<void(const Checkpoint&)> on_checkpoint = {};
};

struct Settled {
  Ending ending = Ending::kTimeLimit;
  double time = 0;
  double kinetic_energy = 0;  ///< Per disk.
  double residual = 0;        ///< Of the raw forces.
  std::string reason;         ///< For a person: why the run ended as it did.
  StepperReport report;
};

/// Advances until the criteria are met. The criterion is looked at every `stride` steps. `start` gives the
/// counters that a resumed run goes on from. Throws Interrupted after handing over a last checkpoint if the
/// progress callback asks to stop, LibraryError if the state is no longer finite.
Settled settle(Stepper& stepper, const StopCriteria& criteria, int stride, const Listener& listener,
               const Checkpoint* start = nullptr);

}  // namespace indet::sim
