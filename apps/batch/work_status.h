#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/batch/run_items.h"
#include "apps/batch/task_record.h"

namespace indet {

/// How the work of a folder stands, as its files tell.
struct WorkStatus {
  enum class Item : std::uint8_t {
    kDone,
    kRunning,  ///< In the hand of a process that lives.
    kStale,    ///< In the hand of one that does not, or has shown no sign of life for long.
    kFailed,   ///< The last process that tried says so.
    kMissing
  };
  /// A process that was at work when it last wrote its record.
  struct Task {
    TaskRecord record;
    bool is_alive = false;
    double silent = 0;  ///< Seconds since its last sign of life.
  };

  std::vector<Item> items;  ///< In the order of the work.
  std::vector<Task> tasks;  ///< Those that run, or did not end by themselves and left something open.
  std::vector<ItemFailure> failures;
  std::map<std::string, double> seconds;  ///< Of the items that records tell of, by stage.
  std::int64_t starts = 0;                ///< Processes that have worked here.
  double pace = 1;                        ///< Seconds of these items for each second of estimated cost.
  double left = 0;                        ///< Seconds on one core for what is not done, by that pace.
  double longest = 0;                     ///< Of these, of the dearest item.
  std::vector<std::string> warnings;      ///< Records that cannot be read.

  std::int64_t count(Item which) const;
  /// Seconds for what is left on so many tasks of so many threads each.
  double seconds_on(int tasks, int threads) const;
};

/// What the folder is to hold.
struct ExpectedWork {
  std::string digest;  ///< TaskRecord::work
  std::vector<WorkItem> items;
  std::filesystem::path results;  ///< Folder with the file NAME.h5 of each item that is done.
  /// Whether the file of an item counts, of which no record tells.
  std::function<bool(std::size_t item)> is_done;
};

/// Reads the records and the names of the results, and opens only those results that no record tells of. A
/// process counts as alive if its host is this one and it is there, or if its record was written within the
/// last three minutes.
WorkStatus status_of(const std::filesystem::path& folder, const ExpectedWork& work);

}  // namespace indet
