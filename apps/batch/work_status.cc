#include "apps/batch/work_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "libindet/base/error.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

constexpr double kSilence =
    180;  // seconds: a record is written every 30, and clocks of hosts differ a little

/// Since the file was written, by the clock of the file system and that of this host.
double seconds_since_written(const fs::path& path) {
  std::error_code error;
  const auto written = fs::last_write_time(path, error);
  if (error) return 0;
  return std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count();
}

std::unordered_set<std::string> names_in(const fs::path& folder) {
  std::unordered_set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) names.insert(entry.path().stem().string());
  return names;
}

class Examiner {
 public:
  Examiner(const fs::path& folder, const ExpectedWork& work) : folder_(folder), work_(work) {}

  WorkStatus run() {
    read_records();
    const auto there = names_in(work_.results);
    std::unordered_map<std::string, std::size_t> number;
    for (std::size_t i = 0; i < work_.items.size(); ++i) {
      const WorkItem& item = work_.items[i];
      number[item.name] = i;
      const bool is_done = there.contains(item.name) && (recorded_.contains(item.name) || work_.is_done(i));
      status_.items.push_back(is_done ? WorkStatus::Item::kDone : WorkStatus::Item::kMissing);
    }
    for (const auto& [name, failure] : failed_) {
      const auto found = number.find(name);
      if (found == number.end() || status_.items[found->second] == WorkStatus::Item::kDone) continue;
      status_.items[found->second] = WorkStatus::Item::kFailed;
      status_.failures.push_back({name, failure.reason});
    }
    for (WorkStatus::Task& task : running_) {
      std::erase_if(task.record.in_hand, [&](const TaskRecord::ItemInHand& item) {
        const auto found = number.find(item.name);
        if (found == number.end()) return true;
        WorkStatus::Item& state = status_.items[found->second];
        if (state == WorkStatus::Item::kDone) return true;
        if (state != WorkStatus::Item::kRunning)
          state = task.is_alive ? WorkStatus::Item::kRunning : WorkStatus::Item::kStale;
        return false;
      });
      if (task.is_alive || !task.record.in_hand.empty()) status_.tasks.push_back(std::move(task));
    }
    estimate();
    return std::move(status_);
  }

 private:
  void read_records() {
    std::error_code error;
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(tasks_folder(folder_), error)) {
      if (entry.path().extension() == ".json") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    for (const fs::path& path : paths) {
      try {
        TaskRecord record = read_task_record(path);
        if (record.work != work_.digest) continue;
        ++status_.starts;
        add(record);
        if (record.state != "running") continue;
        WorkStatus::Task task{std::move(record), false, seconds_since_written(path)};
        task.is_alive =
            task.record.host == host_in_names() ? is_alive(task.record.process) : task.silent < kSilence;
        running_.push_back(std::move(task));
      } catch (const InputError& unreadable) {
        status_.warnings.emplace_back(unreadable.what());
      }
    }
    // The living last, so that what they have in hand is not called stale.
    std::stable_sort(running_.begin(), running_.end(),
                     [](const auto& a, const auto& b) { return a.is_alive < b.is_alive; });
  }

  void add(const TaskRecord& record) {
    for (const TaskRecord::DoneItem& item : record.done) {
      double& all = recorded_[item.name];
      all = 0;  // computed twice by chance, it is counted once here and twice by stage
      for (const auto& [stage, seconds] : item.seconds) {
        status_.seconds[stage] += seconds;
        all += seconds;
      }
    }
    for (const ItemFailure& failure : record.failures) {
      Failure& last = failed_[failure.item];
      if (record.updated >= last.time) last = {record.updated, failure.reason};
    }
  }

  void estimate() {
    double cost = 0, seconds = 0;
    for (const WorkItem& item : work_.items) {
      const auto found = recorded_.find(item.name);
      if (found == recorded_.end()) continue;
      cost += item.cost;
      seconds += found->second;
    }
    if (cost > 0) status_.pace = seconds / cost;
    for (std::size_t i = 0; i < work_.items.size(); ++i) {
      if (status_.items[i] == WorkStatus::Item::kDone) continue;
      const double expected = status_.pace * work_.items[i].cost;
      status_.left += expected;
      status_.longest = std::max(status_.longest, expected);
    }
  }

  struct Failure {
    std::int64_t time = 0;
    std::string reason;
  };

  const fs::path& folder_;
  const ExpectedWork& work_;
  std::unordered_map<std::string, double> recorded_;  ///< Seconds of the items that a record calls done.
  std::map<std::string, Failure> failed_;
  std::vector<WorkStatus::Task> running_;
  WorkStatus status_;
};

}  // namespace

std::int64_t WorkStatus::count(Item which) const { return std::count(items.begin(), items.end(), which); }

double WorkStatus::seconds_on(int tasks_at_work, int threads) const {
  return std::max(longest, left / (static_cast<double>(tasks_at_work) * threads));
}

WorkStatus status_of(const fs::path& folder, const ExpectedWork& work) {
  return Examiner(folder, work).run();
}

}  // namespace indet
