#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace indet {

struct ItemFailure {
  std::string item;
  std::string reason;
};

/// What one process has done in a folder that several share, and what it is at.
struct TaskRecord {
  struct DoneItem {
    std::string name;
    std::map<std::string, double> seconds;  ///< By stage.
  };
  struct ItemInHand {
    std::string name;
    std::int64_t since = 0;  ///< Unix time.
  };

  std::string work = {};   ///< Digest of what the folder is to hold: records of other work do not count.
  std::string shard = {};  ///< "3/8"; empty: all of it.
  std::string host = {};
  std::int64_t process = 0;
  std::string job = {};                   ///< Of the scheduler, "117_3"; empty without one.
  std::int64_t started = 0, updated = 0;  ///< Unix time.
  int threads = 1;
  std::string state = "running";  ///< Or: done, stopped, out of time, failed.
  /// An item was finished, or a checkpoint written: another start will not just do the same again.
  bool got_further = false;
  std::int64_t there_already = 0;  ///< Items that others had done.
  std::vector<DoneItem> done = {};
  std::vector<ItemFailure> failures = {};
  std::vector<ItemInHand> in_hand = {};
};

/// FOLDER/tasks, with a file a process.
std::filesystem::path tasks_folder(const std::filesystem::path& folder);

/// As JSON, whole at any time. Throws like write_note.
void write_task_record(const std::filesystem::path& path, const TaskRecord& record);
/// Throws InputError, which names the file, if it is no such record.
TaskRecord read_task_record(const std::filesystem::path& path);

}  // namespace indet
