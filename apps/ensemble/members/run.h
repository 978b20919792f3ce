#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/ensemble/members/plan.h"
#include "libindet/base/progress.h"
#include "libindet/io/packing_file.h"

namespace indet {

struct RunOptions {
  int threads = 1;
  int first = 0;  ///< Members first … last of the plan.
  int last = -1;  ///< −1: to the end.
  ProgressCallback progress;
  Provenance provenance;
};

struct MemberFailure {
  std::string member;
  std::string reason;
};

struct RunSummary {
  int done = 0;     ///< Computed now.
  int skipped = 0;  ///< Found complete, with the same configuration.
  std::vector<MemberFailure> failures;
};

/// Computes the members of a plan that are not done yet, the most expensive first, and writes one file for
/// each to FOLDER/members. Members run in parallel, each on one thread; only one thread at a time is in HDF5.
/// What fails is listed and does not stop the others. Throws Interrupted if the callback asks to stop: files
/// that exist are whole, and another call goes on from there.
RunSummary compute_members(const EnsembleConfig& config, const Plan& plan,
                           const std::filesystem::path& folder, const RunOptions& options);

}  // namespace indet
