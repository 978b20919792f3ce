#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/task_log.h"
#include "libindet/base/progress.h"

namespace indet {

/// Something to compute, which ends in a file of its own.
struct WorkItem {
  std::string name;
  double cost = 0;  ///< Estimated seconds on one core.
  /// Index of the item whose file this one reads: it starts when that one is finished or has failed.
  std::optional<std::size_t> after = std::nullopt;
};

struct Batch {
  std::vector<WorkItem> items;     ///< In the order in which they are taken.
  std::int64_t there_already = 0;  ///< Further ones, that were done before.
  /// Whether another process has done it meanwhile. On any thread, as `compute`.
  std::function<bool(std::size_t item)> is_done;
  /// Computes it and writes its file; returns the seconds of each stage. `progress` says when to stop, by
  /// Interrupted. Other exceptions are failures of this item, except UnwritablePath and WritingFailed.
  std::function<std::map<std::string, double>(std::size_t item, const ProgressCallback& progress)> compute;
};

struct BatchOptions {
  int threads = 1;
  std::string stage = {};          ///< Of the progress bar: "ensemble".
  std::string items = {};          ///< What they are: "packings".
  ProgressCallback progress = {};  ///< On the calling thread.
  /// Seconds from now within which all is to end: no item is started that would probably last longer. The
  /// first one of each thread is started in any case, else short budgets would never come to an end.
  std::optional<double> time_budget = std::nullopt;
  TaskLog* log = nullptr;
};

struct BatchSummary {
  int done = 0;                       ///< Computed now.
  std::int64_t there_already = 0;     ///< At the start, or when its turn came.
  std::vector<ItemFailure> failures;  ///< By name.
  bool is_interrupted = false;        ///< The callback asked to stop; the rest is not done.
  std::int64_t out_of_time = 0;       ///< Items that were not started, for the time budget.
};

/// Computes the items on several threads. One that fails does not stop the others; a file that cannot be
/// written, as on a full disk, ends all: throws that UnwritablePath or WritingFailed. What was interrupted is
/// gone on with by another call, here or elsewhere.
BatchSummary run_items(const Batch& batch, const BatchOptions& options);

}  // namespace indet
