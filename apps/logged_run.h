#pragma once

#include <filesystem>
#include <functional>

#include "apps/batch/run_items.h"
#include "apps/batch/task_log.h"
#include "apps/command.h"

namespace indet::app {

/// Does work of a folder that several processes share, and notes in FOLDER/tasks what becomes of it, whatever
/// way it ends. `record`: work and shard; the rest is filled in.
BatchSummary run_with_log(const std::filesystem::path& folder, TaskRecord record, const Context& context,
                          const std::function<BatchSummary(TaskLog&)>& work);

}  // namespace indet::app
