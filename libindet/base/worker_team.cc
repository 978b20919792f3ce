#include "libindet/base/worker_team.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace indet {

struct WorkerTeam::Impl {
  std::mutex mutex;
  std::condition_variable wake;
  std::condition_variable finished;
  const std::function<void(int, std::int64_t)>* task = nullptr;
  std::atomic<std::int64_t> next{0};
  std::int64_t count = 0;
  bool pinned = false;
  std::int64_t round = 0;
  int busy = 0;
  bool ending = false;
  std::exception_ptr failure;
  std::int64_t failed_index = 0;
  std::function<void(int)> on_exit;
  int workers = 1;
  std::vector<std::jthread> threads;

  void work(int worker) {
    const auto following = [&](std::int64_t index) { return pinned ? index + workers : next++; };
    for (std::int64_t index = pinned ? worker : next++; index < count; index = following(index)) {
      try {
        (*task)(worker, index);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure || index < failed_index) {
          failure = std::current_exception();
          failed_index = index;
        }
      }
    }
  }

  void live(int worker) {
    std::int64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return ending || round != seen; });
        if (ending) break;
        seen = round;
      }
      work(worker);
      const std::scoped_lock lock(mutex);
      if (--busy == 0) finished.notify_all();
    }
    if (on_exit) on_exit(worker);
  }

  void run(std::int64_t tasks, const std::function<void(int, std::int64_t)>& work_on, bool is_pinned) {
    {
      const std::scoped_lock lock(mutex);
      task = &work_on;
      count = tasks;
      pinned = is_pinned;
      next = 0;
      failure = nullptr;
      busy = static_cast<int>(threads.size());
      ++round;
    }
    wake.notify_all();
    work(0);
    std::unique_lock lock(mutex);
    finished.wait(lock, [this] { return busy == 0; });
    if (failure) std::rethrow_exception(failure);
  }
};

WorkerTeam::WorkerTeam(int workers, std::function<void(int)> on_exit) : impl_(std::make_unique<Impl>()) {
  impl_->workers = std::max(1, workers);
  impl_->on_exit = std::move(on_exit);
  for (int i = 1; i < impl_->workers; ++i) {
    impl_->threads.emplace_back([impl = impl_.get(), i] { impl->live(i); });
  }
}

WorkerTeam::~WorkerTeam() {
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->ending = true;
  }
  impl_->wake.notify_all();
}

int WorkerTeam::workers() const { return impl_->workers; }

void WorkerTeam::run(std::int64_t count, const std::function<void(int, std::int64_t)>& task) {
  impl_->run(count, task, false);
}

void WorkerTeam::run_pinned(std::int64_t count, const std::function<void(int, std::int64_t)>& task) {
  impl_->run(count, task, true);
}

}  // namespace indet
