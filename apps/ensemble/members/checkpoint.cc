#include "apps/ensemble/members/checkpoint.h"

#include <utility>

#include "apps/bridge/simulation_values.h"
#include "apps/ensemble/members/folder.h"
#include "libindet/base/error.h"
#include "libindet/io/destination.h"
#include "libindet/io/simulation_file.h"

namespace indet {

MemberCheckpoint::MemberCheckpoint(const std::filesystem::path& folder, const Member& member,
                                   const CheckpointRules& rules, Provenance provenance, std::mutex& hdf5)
    : path_(checkpoint_path(folder, member.name)),
      fingerprint_(member.hash),
      rules_(rules),
      provenance_(std::move(provenance)),
      hdf5_(hdf5) {}

std::optional<sim::Checkpoint> MemberCheckpoint::load(const sim::World& start) const {
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) return std::nullopt;
  const std::scoped_lock lock(hdf5_);
  try {
    const StoredCheckpoint stored = read_checkpoint(open_indet_file(path_));
    if (stored.fingerprint != fingerprint_) return std::nullopt;
    return loaded(stored, start);
  } catch (const InputError&) {
    return std::nullopt;  // damaged: from the beginning, then
  }
}

void MemberCheckpoint::save(const sim::Checkpoint& checkpoint) const {
  {
    const std::scoped_lock lock(hdf5_);
    make_folder(path_.parent_path());
    write_checkpoint(path_, stored(checkpoint, fingerprint_, {}), provenance_);
  }
  if (rules_.on_written) rules_.on_written();
}

void MemberCheckpoint::remove() const {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  std::filesystem::remove(path_.parent_path(), ignored);  // the last one
}

}  // namespace indet
