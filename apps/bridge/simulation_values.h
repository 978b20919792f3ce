#pragma once

#include <string>

#include "libindet/io/simulation_file.h"
#include "libsim/simulate.h"
#include "libsim/tilt.h"

namespace indet {

/// Between the values of libsim and those that libindet stores.

/// What happened, in units of mg, r_max and √(r_max/g), and the raw contacts.
SimulationRecord record_of(const sim::Simulation& simulation, const sim::SimulationOptions& options);

TiltRecord record_of(const sim::Tilt& tilt, const sim::TiltOptions& options, const sim::World& world);

TrajectoryFrame frame_of(const sim::Frame& frame, const sim::World& world);

StoredCheckpoint stored(const sim::Checkpoint& checkpoint, const std::string& fingerprint,
                        const Trajectory& trajectory);
/// Friction and levers of pairs that do not touch are not part of a packing, so they come from the start of
/// the run.
sim::Checkpoint loaded(const StoredCheckpoint& checkpoint, const sim::World& start);

/// Every option that the outcome depends on, as TOML.
std::string to_toml(const sim::SimulationOptions& options);
std::string to_toml(const sim::TiltOptions& options);

}  // namespace indet
