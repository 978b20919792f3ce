#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "apps/batch/task_record.h"

namespace indet {

/// Keeps the record of this process in FOLDER/tasks: HOST-PROCESS-START.json, rewritten as work goes on. May
/// be told from any thread; the file is written by `refresh` and at the end. What cannot be written is
/// told to `warn` once, and hinders nothing.
class TaskLog {
 public:
  /// `record`: work, shard, job and threads; the rest is filled in.
  TaskLog(const std::filesystem::path& folder, TaskRecord record,
          std::function<void(const std::string&)> warn);
  ~TaskLog();  ///< Ends it as "stopped" where nobody has ended it.
  TaskLog(const TaskLog&) = delete;
  TaskLog& operator=(const TaskLog&) = delete;

  void begin(const std::string& item);
  void finish(const std::string& item, const std::map<std::string, double>& seconds);
  void fail(const std::string& item, const std::string& reason);
  /// Another process has done it, or it was stopped.
  void leave(const std::string& item, bool is_there_already);
  void note_there_already(std::int64_t items);
  void note_checkpoint();
  /// Sets the state, once, and writes it. Not while another call of this thread is under way.
  void end(const std::string& state);

  /// Writes the record if something was noted and the last time is two seconds ago, or half a minute in any
  /// case, by which others see that the process lives.
  void refresh();

 private:
  void drop(const std::string& item);
  void get_further();
  void write();

  std::filesystem::path path_;
  std::function<void(const std::string&)> warn_;
  std::mutex mutex_;  ///< Guards what follows.
  TaskRecord record_;
  bool is_changed_ = true;
  bool is_urgent_ = false;  ///< To be written at the next refresh: it got further.
  bool has_warned_ = false;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace indet
