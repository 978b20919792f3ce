#include "libindet/range/extremal_search.h"

#include <chrono>
#include <utility>

#include "libindet/range/canonical_states.h"
#include "libindet/range/objective_table.h"
#include "libindet/range/optimality_checker.h"
#include "libindet/range/paper_walk.h"
#include "libindet/range/search_rounds.h"

namespace indet {
namespace {

/// What the vertex of a basis tells about all objectives that it could improve.
TaskResult check(const OptimalityChecker& checker, const ObjectiveTable& table, const Basis& basis) {
  TaskResult result;
  result.status = LpStatus::kOptimal;
  result.found = checker.recompute(basis);
  result.verdicts = checker.judge(table.candidates(*result.found), *result.found);
  return result;
}

/// One linear program, from the best known vertex of the objective.
TaskResult solve_value(Maximiser& solver, const OptimalityChecker& checker, const ObjectiveTable& table,
                       std::int64_t objective) {
  const LpAnswer answer = solver.maximise(checker.signed_objective(objective), table.best_basis(objective));
  TaskResult result;
  if (answer.status == LpStatus::kOptimal) {
    result = check(checker, table, answer.basis);
    for (ObjectiveVerdict& verdict : result.verdicts) {
      // The solver calls this optimal: the value stands, and its residual tells how far it can be trusted.
      if (verdict.objective == objective) verdict.optimal = true;
    }
  }
  result.objective = objective;
  result.status = answer.status;
  result.work.add(answer);
  return result;
}

void find_values(const OptimalityChecker& checker, const Basis& start, std::span<const Basis> known_bases,
                 ObjectiveTable& table, SearchRounds& rounds) {
  table.merge({check(checker, table, start)});
  for (const Basis& basis : known_bases) table.merge({check(checker, table, basis)});
  rounds.run(
      [](const ObjectiveProgress& known) {
        return known.wanted && !known.optimal && !known.unbounded && !known.failed;
      },
      [&](Maximiser& solver, std::int64_t objective) {
        return solve_value(solver, checker, table, objective);
      },
      [](ObjectiveProgress& known) { known.failed = !known.optimal && !known.unbounded; });
}

void find_states(const SlopeView& view, const OptimalityChecker& checker, const ObjectiveTable& table,
                 SearchRounds& rounds) {
  const CanonicalStates states(view, checker, table);
  rounds.run(
      CanonicalStates::is_open,
      [&](Maximiser& solver, std::int64_t objective) { return states.find(solver, objective); },
      [](ObjectiveProgress& known) { known.stateless = !known.canonical; });
}

/// Collects vertices of the table, each once.
class VertexCollector {
 public:
  VertexCollector(const ObjectiveTable& table, std::vector<Vertex>& vertices)
      : table_(table), vertices_(vertices), number_(static_cast<std::size_t>(table.vertex_count()), -1) {}

  /// Its index among the collected vertices.
  int add(int vertex) {
    int& number = number_[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = static_cast<int>(vertices_.size());
      vertices_.push_back(table_.vertex(vertex));
    }
    return number;
  }

 private:
  const ObjectiveTable& table_;
  std::vector<Vertex>& vertices_;
  std::vector<int> number_;
};

SearchResult result_of(const OptimalityChecker& checker, const ObjectiveTable& table,
                       const SearchOptions& options) {
  SearchResult result;
  result.solves = table.work().solves;
  result.continued = table.work().continued;
  result.pivots = table.work().pivots;
  result.paper = table.paper_work();
  VertexCollector collector(table, result.vertices);
  for (std::int64_t objective = 0; objective < table.count(); ++objective) {
    const ObjectiveProgress& known = table[objective];
    Extremum extremum;
    if (known.wanted && known.optimal) {
      extremum.status = Extremum::Status::kOptimal;
      if (options.sink) {
        extremum.value = OptimalityChecker::sign_of(objective) * known.best;
      } else {
        extremum.vertex = collector.add(known.vertex);
        if (options.solver_states) extremum.solver_vertex = collector.add(known.settled_at);
        extremum.value = checker.value_of(objective / 2, table.vertex(known.vertex).x);
      }
      extremum.dual_residual = known.dual_residual;
      extremum.proof = known.proof;
      extremum.unique = known.unique;
    } else if (known.wanted) {
      extremum.status = known.unbounded ? Extremum::Status::kUnbounded : Extremum::Status::kFailed;
    }
    (objective % 2 == 0 ? result.minimum : result.maximum).push_back(std::move(extremum));
  }
  return result;
}

}  // namespace

SearchResult search_extrema(const SlopeView& view, const std::vector<Component>& components,
                            const Eigen::VectorXd& weight, const Basis& start, const SearchOptions& options,
                            std::span<const Basis> known) {
  const OptimalityChecker checker(view, components, weight, options.canonical_states);
  ObjectiveTable table(components, options.canonical_states, options.sink);
  SearchRounds rounds(view, options, table);
  if (options.method == Method::kPivotingPaper) {
    walk_to_values(view, checker, start, options.paper, table, rounds);
  } else {
    find_values(checker, start, known, table, rounds);
  }
  const auto middle = std::chrono::steady_clock::now();
  if (options.canonical_states) find_states(view, checker, table, rounds);
  SearchResult found = result_of(checker, table, options);
  found.state_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
  return found;
}

}  // namespace indet
