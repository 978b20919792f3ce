#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/batch/run_items.h"
#include "apps/batch/task_log.h"
#include "apps/command.h"
#include "libindet/base/progress.h"

namespace indet::app {

/// Does work of a folder that several processes share, and notes in FOLDER/tasks what becomes of it, whatever
/// way it ends. `record`: work and shard; the rest is filled in.
BatchSummary run_with_log(const std::filesystem::path& folder, TaskRecord record, const Context& context,
                          const std::function<BatchSummary(TaskLog&)>& work);

/// Shows the progress of such work; should it be stopped, that is what is left.
ProgressCallback shared_progress(const Context& context);

/// How a run ended that does not collect the results.
struct ShareReport {
  std::filesystem::path folder;
  std::string item;  ///< What it consists of: "member".
  std::string part;  ///< "shard 3/8"; empty: all, as far as time sufficed.
  std::string next;  ///< What to do once all is done.
};

/// Says what it did; returns the exit status.
int report_share(const ShareReport& report, const BatchSummary& summary, double seconds,
                 const Context& context);

/// [{"ITEM": …, "reason": …}]
nlohmann::json to_json(const std::vector<ItemFailure>& failures, const std::string& item);

}  // namespace indet::app
