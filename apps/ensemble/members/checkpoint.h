#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "apps/ensemble/members/plan.h"
#include "libindet/io/packing_file.h"
#include "libsim/settle.h"

namespace indet {

/// When the simulation of a packing leaves a checkpoint, from which another run goes on to the same result.
struct CheckpointRules {
  double worth_keeping = 5;  ///< Seconds; what has taken less is rather computed again.
  double interval = 600;     ///< Seconds between checkpoints, for hosts that fail without a word.
  /// Asked for once a simulation is worth keeping; while what it returns lives, a program that is told to
  /// stop leaves the time to write it.
  std::function<std::shared_ptr<void>()> hold_on;
  std::function<void()> on_written;
};

/// The checkpoint of one member, FOLDER/checkpoints/NAME.h5. Uses HDF5, under the mutex.
class MemberCheckpoint {
 public:
  MemberCheckpoint(const std::filesystem::path& folder, const Member& member, const CheckpointRules& rules,
                   Provenance provenance, std::mutex& hdf5);

  /// What an interrupted run left, if it was of this very simulation.
  std::optional<sim::Checkpoint> load(const sim::World& start) const;
  void save(const sim::Checkpoint& checkpoint) const;
  /// The member is done.
  void remove() const;

  const CheckpointRules& rules() const { return rules_; }

 private:
  std::filesystem::path path_;
  std::string fingerprint_;
  const CheckpointRules& rules_;
  Provenance provenance_;
  std::mutex& hdf5_;
};

}  // namespace indet
