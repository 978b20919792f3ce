#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libindet/io/packing_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// What a simulation adds to the file of the packing that it made, as plain values: /simulation holds what
/// happened and the raw contacts, /tilt how gravity was turned, /trajectory the states on the way.

/// /tilt: numbers and texts become attributes, the rest datasets, in the scene's own units.
struct TiltRecord {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;
  // A row a state on the way.
  std::vector<double> angle, kinetic_energy, displacement;
  std::vector<std::int32_t> contacts, sliding;
  std::vector<double> moved_at;  ///< Of each disk.
};

/// /simulation: numbers and texts become attributes, the contacts datasets as in /contacts.
struct SimulationRecord {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;
  std::vector<Contact> raw_contacts;  ///< Of the last step, before the polish.
  std::optional<TiltRecord> tilt;
};

/// One state on the way.
struct TrajectoryFrame {
  double time = 0;  ///< Scene's own unit.
  std::vector<Vector2> positions, velocities;
  std::vector<double> angles, angular_velocities;
  std::vector<Contact> contacts;
};

/// /trajectory: time [F], position [F, N, 2] and so on; contacts of frame f are rows first_contact[f] …
/// first_contact[f+1] − 1 of the contact datasets.
using Trajectory = std::vector<TrajectoryFrame>;

void write_simulation(const std::filesystem::path& path, const Packing& packing,
                      const SimulationRecord& record, const Trajectory& trajectory,
                      const Provenance& provenance);

/// /simulation alone, for the writers of files that hold more.
void write_simulation_part(Hdf5File& file, const SimulationRecord& record);

/// Throws InputError if the file has none.
Trajectory read_trajectory(const Hdf5File& file);

/// A run that can be continued: its state as a packing (with velocities), and for each contact what is not in
/// one.
struct StoredCheckpoint {
  std::string fingerprint;  ///< Text of the options: a run continues only with the same.
  Packing state;
  std::vector<double> spring;  ///< Of each contact.
  std::vector<double> change;  ///< Of each contact.
  std::map<std::string, std::int64_t> counters;
  Trajectory trajectory;  ///< So far.
};

void write_checkpoint(const std::filesystem::path& path, const StoredCheckpoint& checkpoint,
                      const Provenance& provenance);
/// Throws InputError if the file is no checkpoint.
StoredCheckpoint read_checkpoint(const Hdf5File& file);

}  // namespace indet
