#include "apps/batch/task_log.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds kBetweenWrites{2};
constexpr Seconds kSignOfLife{30};

std::int64_t unix_time() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

TaskLog::TaskLog(const std::filesystem::path& folder, TaskRecord record,
                 std::function<void(const std::string&)> warn)
    : warn_(std::move(warn)), record_(std::move(record)) {
  record_.host = host_in_names();
  record_.process = getpid();
  record_.started = unix_time();
  path_ = tasks_folder(folder) / fmt::format("{}-{}-{}.json", record_.host, record_.process, record_.started);
  std::error_code error;  // told where the file is written
  std::filesystem::create_directories(tasks_folder(folder), error);
  write();
}

TaskLog::~TaskLog() {
  if (record_.state == "running") end("stopped");
}

void TaskLog::get_further() {
  is_urgent_ = is_urgent_ || !record_.got_further;
  record_.got_further = true;
  is_changed_ = true;
}

void TaskLog::drop(const std::string& item) {
  std::erase_if(record_.in_hand, [&](const TaskRecord::ItemInHand& other) { return other.name == item; });
  is_changed_ = true;
}

void TaskLog::begin(const std::string& item) {
  const std::scoped_lock lock(mutex_);
  record_.in_hand.push_back({item, unix_time()});
  is_changed_ = true;
}

void TaskLog::finish(const std::string& item, const std::map<std::string, double>& seconds) {
  const std::scoped_lock lock(mutex_);
  drop(item);
  record_.done.push_back({item, seconds});
  get_further();
}

void TaskLog::fail(const std::string& item, const std::string& reason) {
  const std::scoped_lock lock(mutex_);
  drop(item);
  record_.failures.push_back({item, reason});
}

void TaskLog::leave(const std::string& item, bool is_there_already) {
  const std::scoped_lock lock(mutex_);
  drop(item);
  if (is_there_already) ++record_.there_already;
}

void TaskLog::note_there_already(std::int64_t items) {
  const std::scoped_lock lock(mutex_);
  record_.there_already += items;
  is_changed_ = true;
}

void TaskLog::note_checkpoint() {
  const std::scoped_lock lock(mutex_);
  get_further();
}

void TaskLog::end(const std::string& state) {
  const std::scoped_lock lock(mutex_);
  if (record_.state != "running") return;  // the first word holds
  record_.state = state;
  record_.in_hand.clear();
  write();
}

void TaskLog::refresh() {
  const std::scoped_lock lock(mutex_);
  const auto age = std::chrono::steady_clock::now() - written_;
  if (is_urgent_ || age > kSignOfLife || (is_changed_ && age > kBetweenWrites)) write();
}

void TaskLog::write() {
  is_changed_ = is_urgent_ = false;
  written_ = std::chrono::steady_clock::now();
  record_.updated = unix_time();
  try {
    write_task_record(path_, record_);
  } catch (const std::exception& error) {  // on a full disk, or after a signal
    if (!std::exchange(has_warned_, true) && warn_ && dynamic_cast<const Interrupted*>(&error) == nullptr)
      warn_(fmt::format("{}; indet status will not know of this process", error.what()));
  }
}

}  // namespace indet
