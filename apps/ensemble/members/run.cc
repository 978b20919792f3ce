#include "apps/ensemble/members/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <random>
#include <thread>

#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/member_file.h"
#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/base/worker_team.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

using std::chrono::milliseconds;

/// What the workers share.
class Batch {
 public:
  Batch(const EnsembleConfig& config, const Plan& plan, const std::filesystem::path& folder,
        const RunOptions& options)
      : config_(config), plan_(plan), folder_(folder), options_(options) {
    const int last = options.last < 0 ? static_cast<int>(plan.members.size()) - 1 : options.last;
    for (const Member& member : plan.members) {
      if (member.number < options.first || member.number > last) continue;
      const MemberState state = examine_member(member_path(folder, member.name), member);
      if (state.status == MemberStatus::kUnreadable && options.warn)
        options.warn(state.reason + "; it is computed again");
      if (state.status == MemberStatus::kDone) {
        ++summary_.skipped;
      } else {
        open_.push_back(&member);
        total_cost_ += member.cost;
      }
    }
    asked_ = open_.size() + static_cast<std::size_t>(summary_.skipped);
    Random random(std::random_device{}());
    for (std::size_t i = open_.size(); i > 1; --i) std::swap(open_[i - 1], open_[random.below(i)]);
    std::stable_sort(open_.begin(), open_.end(),
                     [](const Member* a, const Member* b) { return a->cost > b->cost; });
  }

  RunSummary run() {
    std::exception_ptr failure;
    std::thread driver([&] {
      try {
        WorkerTeam team(std::min(options_.threads, static_cast<int>(open_.size())));
        team.run(static_cast<std::int64_t>(open_.size()), [&](int, std::int64_t index) {
          if (!stop_) work(*open_[static_cast<std::size_t>(index)]);
        });
      } catch (...) {
        failure = std::current_exception();
      }
      const std::scoped_lock lock(mutex_);
      finished_ = true;
      changed_.notify_all();
    });
    watch();
    driver.join();
    if (failure) std::rethrow_exception(failure);
    summary_.interrupted = stop_;
    std::sort(summary_.failures.begin(), summary_.failures.end(),
              [](const MemberFailure& a, const MemberFailure& b) { return a.member < b.member; });
    return summary_;
  }

 private:
  /// Reports progress from the calling thread until the workers are done.
  void watch() {
    std::unique_lock lock(mutex_);
    for (bool is_last = false; !is_last;) {
      changed_.wait_for(lock, milliseconds(100), [this] { return finished_; });
      is_last = finished_;
      const std::string details =
          fmt::format("{} of {} packings{}", summary_.done + summary_.skipped, asked_,
                      summary_.failures.empty() ? "" : fmt::format(", {} failed", summary_.failures.size()));
      const Progress progress{.stage = "ensemble",
                              .done = static_cast<std::int64_t>(1000 * done_cost_),
                              .total = static_cast<std::int64_t>(1000 * total_cost_),
                              .details = details};
      lock.unlock();
      if (options_.progress && !options_.progress(progress)) stop_ = true;
      lock.lock();
    }
  }

  void work(const Member& member) {
    try {
      if (is_done_now(member)) {
        count(member, summary_.skipped);
        return;
      }
      const MemberResult result = compute_member(config_, member, source(member), start(member),
                                                 [this](const Progress&) { return !stop_; });
      if (!is_done_now(member)) {
        const std::scoped_lock lock(hdf5_);
        write_member(member_path(folder_, member.name), member, result, options_.provenance);
      }
    } catch (const Interrupted&) {
      stop_ = true;
      return;
    } catch (const std::exception& error) {
      const std::scoped_lock lock(mutex_);
      summary_.failures.push_back({member.name, error.what()});
      done_cost_ += member.cost;
      return;
    }
    count(member, summary_.done);
  }

  void count(const Member& member, int& counter) {
    const std::scoped_lock lock(mutex_);
    ++counter;
    done_cost_ += member.cost;
  }

  /// Another process may have done it meanwhile.
  bool is_done_now(const Member& member) {
    const std::scoped_lock lock(hdf5_);
    return member_is_done(member_path(folder_, member.name), member);
  }

  std::optional<Packing> source(const Member& member) {
    if (member.source.empty()) return std::nullopt;
    const std::scoped_lock lock(hdf5_);
    return read_packing(member.source);
  }

  /// The cd1 packing of the same seed, if it is there already.
  std::optional<Packing> start(const Member& member) {
    if (!starts_from_cd1(member.protocol)) return std::nullopt;
    for (const Member& other : plan_.members) {
      if (other.protocol != sim::Protocol::kCd1 || other.seed != member.seed) continue;
      const std::filesystem::path path = member_path(folder_, other.name);
      const std::scoped_lock lock(hdf5_);
      if (member_is_done(path, other)) return read_packing(path);
    }
    return std::nullopt;
  }

  const EnsembleConfig& config_;
  const Plan& plan_;
  const std::filesystem::path& folder_;
  const RunOptions& options_;
  std::vector<const Member*> open_;
  std::size_t asked_ = 0;  ///< Members of this run, those included that were done before.
  double total_cost_ = 0;
  std::mutex hdf5_;
  std::mutex mutex_;  ///< Guards the members below.
  std::condition_variable changed_;
  RunSummary summary_;
  double done_cost_ = 0;
  bool finished_ = false;
  std::atomic<bool> stop_ = false;
};

}  // namespace

RunSummary compute_members(const EnsembleConfig& config, const Plan& plan,
                           const std::filesystem::path& folder, const RunOptions& options) {
  std::filesystem::create_directories(members_folder(folder));
  remove_leftovers(folder);
  remove_leftovers(members_folder(folder));
  return Batch(config, plan, folder, options).run();
}

}  // namespace indet
