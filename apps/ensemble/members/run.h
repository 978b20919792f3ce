#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/run_items.h"
#include "apps/ensemble/members/checkpoint.h"
#include "apps/ensemble/members/plan.h"
#include "libindet/base/progress.h"
#include "libindet/io/packing_file.h"

namespace indet {

struct RunOptions {
  int threads = 1;
  ProgressCallback progress;
  std::function<void(const std::string&)> warn;  ///< Told what is computed again, and why.
  std::optional<double> time_budget;             ///< BatchOptions::time_budget
  TaskLog* log = nullptr;
  CheckpointRules checkpoints;
  Provenance provenance;
};

/// Computes those of these members of a plan that are not done yet, the most expensive first, and writes one
/// file for each to FOLDER/members. Members are computed in parallel, each on one thread; only one thread at
/// a time is in HDF5. What fails is listed and does not stop the others; what was interrupted is gone on with
/// by another call.
///
/// Any number of processes, on any hosts that share the folder, may do this at the same time. The files are
/// all that they share: one that exists is whole and is left as it is. Each process takes members of equal
/// cost in an order of its own and passes over those that another one has done meanwhile, so that few are
/// computed twice, with the same result. A member that starts from another one waits for it.
BatchSummary compute_members(const EnsembleConfig& config, const Plan& plan,
                             const std::vector<Member>& members, const std::filesystem::path& folder,
                             const RunOptions& options);

}  // namespace indet
