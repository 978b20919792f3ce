#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "libindet/base/worker_team.h"
#include "libindet/lp/feasible_set.h"
#include "libindet/lp/maximiser.h"
#include "libindet/range/objective_table.h"
#include "libindet/range/search_options.h"

namespace indet {

/// Schedules the objectives of a search on its threads, in rounds of fixed size. The members of a round start
/// from what was known before it, and what they found is merged in their order, so that the result does not
/// depend on the number of threads (docs/decisions/rounds.md).
///
/// Each member has a slot with a solver of its own, which is always used on the same thread. What a solver
/// answers depends, through rounding, on what it was asked before, so solvers belong to slots, which are as
/// many for any number of threads.
class SearchRounds {
 public:
  using IsOpen = std::function<bool(const ObjectiveProgress&)>;
  using Task = std::function<TaskResult(Maximiser& solver, std::int64_t objective)>;
  using IndependentTask = std::function<TaskResult(std::int64_t objective)>;
  using Close = std::function<void(ObjectiveProgress&)>;

  /// All must outlive the rounds.
  SearchRounds(const SlopeView& view, const SearchOptions& options, ObjectiveTable& table);

  /// Runs `task` on open objectives until none is left; `close`, called for each after its round, must make
  /// it no longer open. Throws Interrupted.
  void run(const IsOpen& is_open, const Task& task, const Close& close);

  /// Runs `task`, which needs no solver, on the given objectives, whose order does not matter to it.
  /// Throws Interrupted.
  void run_independent(const std::vector<std::int64_t>& objectives, const IndependentTask& task,
                       const Close& close);

 private:
  struct SolverSlot {
    std::unique_ptr<Maximiser> solver;
    int vertex = -1;  ///< at which the solver stands; −1: none that is kept
  };
  /// Objectives a round. More let more threads work at once, but start from older knowledge: at N = 95,
  /// rounds of 2 cost 2 % more pivots than rounds of 1, rounds of 4 cost 12 %.
  static constexpr std::size_t kRound = 2;

  void leave(int worker);
  Maximiser& solver_of(SolverSlot& slot) const;
  std::vector<std::int64_t> choose_members(const IsOpen& is_open);
  void report() const;

  const SlopeView& view_;
  const SearchOptions& options_;
  ObjectiveTable& table_;
  std::array<SolverSlot, kRound> slots_;
  std::int64_t first_open_ = 0;  ///< no objective before is open
  WorkerTeam team_;              // last: its threads use the members above
};

}  // namespace indet
