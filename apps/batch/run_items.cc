#include "apps/batch/run_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/stopwatch.h"
#include "libindet/base/worker_team.h"

namespace indet {
namespace {

class Runner {
 public:
  Runner(const Batch& batch, const BatchOptions& options)
      : batch_(batch), options_(options), states_(batch.items.size(), State::kOpen) {
    summary_.there_already = batch.there_already;
    for (const WorkItem& item : batch.items) total_cost_ += item.cost;
    if (options_.log != nullptr) options_.log->note_there_already(batch.there_already);
  }

  BatchSummary run() {
    std::exception_ptr failure;
    std::thread driver([&] {
      try {
        const int workers = std::min(options_.threads, static_cast<int>(batch_.items.size()));
        WorkerTeam team(std::max(1, workers));
        team.run_pinned(workers, [&](int, std::int64_t) { work(); });
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
    if (unwritable_) std::rethrow_exception(unwritable_);
    summary_.is_interrupted = stop_;
    summary_.out_of_time = std::count(states_.begin(), states_.end(), State::kOpen);
    if (stop_) summary_.out_of_time = 0;
    std::sort(summary_.failures.begin(), summary_.failures.end(),
              [](const auto& a, const auto& b) { return a.item < b.item; });
    return summary_;
  }

 private:
  enum class State : std::uint8_t { kOpen, kInHand, kFinished };

  /// Reports progress from the calling thread until the workers are done.
  void watch() {
    std::unique_lock lock(mutex_);
    for (bool is_last = false; !is_last;) {
      finished_or_due_.wait_for(lock, std::chrono::milliseconds(100), [this] { return finished_; });
      is_last = finished_;
      const std::string details =
          fmt::format("{} of {} {}{}", summary_.done + summary_.there_already,
                      std::ssize(batch_.items) + batch_.there_already, options_.items,
                      summary_.failures.empty() ? "" : fmt::format(", {} failed", summary_.failures.size()));
      const Progress progress{.stage = options_.stage,
                              .done = static_cast<std::int64_t>(1000 * done_cost_),
                              .total = static_cast<std::int64_t>(1000 * total_cost_),
                              .details = details};
      lock.unlock();
      if (options_.log != nullptr) options_.log->refresh();
      if (options_.progress && !options_.progress(progress)) stop();
      lock.lock();
    }
  }

  void stop() {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
    changed_.notify_all();
  }

  /// Ends all: no other file could be written either.
  void give_up(const std::string& item, const std::string& reason, std::exception_ptr error) {
    if (options_.log != nullptr) options_.log->fail(item, reason);
    {
      const std::scoped_lock lock(mutex_);
      if (!unwritable_) unwritable_ = std::move(error);
    }
    stop();
  }

  void work() {
    bool is_first = true;
    while (const std::optional<std::size_t> item = take(is_first)) {
      is_first = false;
      compute(*item);
    }
  }

  /// The next item that can begin; waits where all that are left wait for one in hand. Nothing: there is
  /// none, or none that time is left for.
  std::optional<std::size_t> take(bool is_first) {
    std::unique_lock lock(mutex_);
    for (;;) {
      if (stop_) return std::nullopt;
      bool is_any_waiting = false;
      for (std::size_t i = first_open_; i < states_.size(); ++i) {
        if (states_[i] != State::kOpen) {
          if (i == first_open_) ++first_open_;
          continue;
        }
        const WorkItem& item = batch_.items[i];
        if (item.after && states_[*item.after] != State::kFinished) {
          is_any_waiting = is_any_waiting || states_[*item.after] == State::kInHand;
          continue;
        }
        if (!is_first && !has_time_for(item)) continue;
        states_[i] = State::kInHand;
        return i;
      }
      if (!is_any_waiting) return std::nullopt;
      changed_.wait(lock);
    }
  }

  /// By the slowest item so far, as a multiple of its estimated cost.
  bool has_time_for(const WorkItem& item) const {
    return !options_.time_budget || since_begin_.seconds() + slowest_ * item.cost < *options_.time_budget;
  }

  void compute(std::size_t index) {
    const WorkItem& item = batch_.items[index];
    TaskLog* const log = options_.log;
    try {
      if (batch_.is_done(index)) {
        if (log != nullptr) log->leave(item.name, true);
        return settle(index, [&] { ++summary_.there_already; });
      }
      if (log != nullptr) log->begin(item.name);
      const Stopwatch watch;
      const auto seconds = batch_.compute(index, [this](const Progress&) { return !stop_; });
      if (log != nullptr) log->finish(item.name, seconds);
      settle(index, [&] {
        ++summary_.done;
        const double pace = watch.seconds() / std::max(item.cost, 1e-3);
        slowest_ = has_pace_ ? std::max(slowest_, pace) : pace;
        has_pace_ = true;
      });
    } catch (const Interrupted&) {
      if (log != nullptr) log->leave(item.name, false);
      stop();
    } catch (const UnwritablePath& error) {
      give_up(item.name, error.what(), std::current_exception());
    } catch (const WritingFailed& error) {
      give_up(item.name, error.what(), std::current_exception());
    } catch (const std::exception& error) {
      if (log != nullptr) log->fail(item.name, error.what());
      settle(index, [&] { summary_.failures.push_back({item.name, error.what()}); });
    }
  }

  template <class Note>
  void settle(std::size_t index, const Note& note) {
    const std::scoped_lock lock(mutex_);
    note();
    states_[index] = State::kFinished;
    done_cost_ += batch_.items[index].cost;
    changed_.notify_all();
  }

  const Batch& batch_;
  const BatchOptions& options_;
  const Stopwatch since_begin_;
  std::mutex mutex_;  ///< Guards the members below.
  std::condition_variable changed_, finished_or_due_;
  std::vector<State> states_;
  std::size_t first_open_ = 0;  ///< No item before it is open.
  BatchSummary summary_;
  std::exception_ptr unwritable_;
  double total_cost_ = 0, done_cost_ = 0;
  double slowest_ = 2;  ///< Seconds of a second of estimated cost; a guess until one is done.
  bool has_pace_ = false;
  bool finished_ = false;
  std::atomic<bool> stop_ = false;  ///< Set with the mutex, read without.
};

}  // namespace

BatchSummary run_items(const Batch& batch, const BatchOptions& options) {
  return Runner(batch, options).run();
}

}  // namespace indet
