#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace indet {

/// A fixed team of threads that work through numbered tasks together. Each worker keeps its thread for the
/// life of the team, because GLPK wants a problem to be created, used and destroyed on one thread. With one
/// worker everything runs on the calling thread.
class WorkerTeam {
 public:
  /// `on_exit` runs on each worker's own thread when the team ends (not on the calling thread).
  explicit WorkerTeam(int workers, std::function<void(int worker)> on_exit = {});
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  int workers() const;

  /// Calls task(worker, index) for every index in [0, count), each once, in any order, and returns when all
  /// are done. The exception of the lowest index that threw one is thrown again.
  void run(std::int64_t count, const std::function<void(int worker, std::int64_t index)>& task);

  /// The same, where worker index mod workers() does each task: what stays with an index stays on its thread.
  void run_pinned(std::int64_t count, const std::function<void(int worker, std::int64_t index)>& task);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indet
