#include "libindet/range/search_rounds.h"

#include <algorithm>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/pivoting/tableau_solver.h"

namespace indet {
namespace {

/// Independent tasks between two reports of progress.
constexpr std::size_t kIndependent = 16;

}  // namespace

SearchRounds::SearchRounds(const SlopeView& view, const SearchOptions& options, ObjectiveTable& table)
    : view_(view),
      options_(options),
      table_(table),
      team_(options.threads, [this](int worker) { leave(worker); }) {}

void SearchRounds::run(const IsOpen& is_open, const Task& task, const Close& close) {
  first_open_ = 0;
  for (;;) {
    const std::vector<std::int64_t> members = choose_members(is_open);
    if (members.empty()) break;
    std::vector<TaskResult> results(members.size());
    team_.run_pinned(static_cast<std::int64_t>(members.size()), [&](int, std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      results[at] = task(solver_of(slots_[at]), members[at]);
    });
    const std::vector<int> vertices = table_.merge(std::move(results));
    for (std::size_t i = 0; i < vertices.size(); ++i) slots_[i].vertex = vertices[i];
    report();
    for (const std::int64_t objective : members) close(table_[objective]);
  }
}

void SearchRounds::run_independent(const std::vector<std::int64_t>& objectives, const IndependentTask& task,
                                   const Close& close) {
  for (std::size_t first = 0; first < objectives.size(); first += kIndependent) {
    const std::size_t count = std::min(kIndependent, objectives.size() - first);
    std::vector<TaskResult> results(count);
    team_.run(static_cast<std::int64_t>(count), [&](int, std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      results[at] = task(objectives[first + at]);
    });
    table_.merge(std::move(results));
    report();
    for (std::size_t i = 0; i < count; ++i) close(table_[objectives[first + i]]);
  }
}

/// Ends the solvers of a thread, on that thread.
void SearchRounds::leave(int worker) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (static_cast<int>(i) % team_.workers() == worker) slots_[i].solver.reset();
  }
}

Maximiser& SearchRounds::solver_of(SolverSlot& slot) const {
  if (!slot.solver && options_.method == Method::kPivotingTableau) {
    slot.solver = std::make_unique<TableauSolver>(view_, options_.pivot_rule, options_.lp);
  } else if (!slot.solver) {
    slot.solver = std::make_unique<LpSolver>(view_, options_.formulation, options_.lp);
  }
  return *slot.solver;
}

/// The members of the next round: for each slot an open objective whose best vertex is the one at which the
/// solver stands, which saves a factorisation or an exchange of inequalities, else the first open one.
std::vector<std::int64_t> SearchRounds::choose_members(const IsOpen& is_open) {
  std::vector<std::int64_t> members;
  const auto first = [&](auto suits) -> std::int64_t {
    for (std::int64_t objective = first_open_; objective < table_.count(); ++objective) {
      const ObjectiveProgress& known = std::as_const(table_)[objective];
      const bool is_taken = std::find(members.begin(), members.end(), objective) != members.end();
      if (is_open(known) && !is_taken && suits(known)) return objective;
    }
    return table_.count();
  };
  const auto any = [](const ObjectiveProgress&) { return true; };
  first_open_ = first(any);
  for (const SolverSlot& slot : slots_) {
    std::int64_t chosen = first([&](const ObjectiveProgress& known) { return known.vertex == slot.vertex; });
    if (chosen == table_.count()) chosen = first(any);
    if (chosen < table_.count()) members.push_back(chosen);
  }
  return members;
}

/// The canonical states of all objectives take about as long as their values, and are found after these.
void SearchRounds::report() const {
  if (!options_.progress) return;
  std::int64_t done = 0;
  std::int64_t total = 0;
  for (const ObjectiveProgress& known : table_.all()) {
    if (!known.wanted) continue;
    total += 2;
    done += table_.is_settled(known) ? 2 : known.optimal ? 1 : 0;
  }
  if (!options_.progress(done, total)) throw Interrupted();
}

}  // namespace indet
