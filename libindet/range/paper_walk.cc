#include "libindet/range/paper_walk.h"

#include <array>
#include <utility>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/pivoting/neighbour_search.h"

namespace indet {
namespace {

bool has_vertex(WalkEnd end) {
  return end != WalkEnd::kDirectionsLost && end != WalkEnd::kPolytopeEdgeWithoutEnd &&
         end != WalkEnd::kStepLimit;
}

TaskResult walk_to_value(const NeighbourSearch& search, const OptimalityChecker& checker,
                         std::int64_t objective, const Basis& start) {
  const NeighbourWalk walk =
      search.walk(checker.signed_objective(objective), start, static_cast<std::uint64_t>(objective));
  TaskResult result;
  result.objective = objective;
  if (has_vertex(walk.end)) {
    result.status = LpStatus::kOptimal;
    result.found = checker.recompute(walk.basis);
    result.verdicts = checker.judge(std::array{objective}, *result.found);
    // As the method says; the residual tells whether it is right.
    result.verdicts.front().optimal = true;
  }
  result.work.solves = 1;
  result.work.pivots = walk.steps;
  result.paper.walks[static_cast<std::size_t>(walk.end)] = 1;
  result.paper.points = walk.steps + 1;
  result.paper.unexpected = walk.unexpected;
  result.paper.neighbours = walk.neighbours;
  return result;
}

}  // namespace

void walk_to_values(const SlopeView& view, const OptimalityChecker& checker, const Basis& start,
                    const PaperOptions& options, ObjectiveTable& table, SearchRounds& rounds) {
  const NeighbourSearch search(view, tolerance::kActive, options.neighbour,
                               static_cast<std::uint64_t>(options.seed));
  const auto close = [](ObjectiveProgress& known) { known.failed = !known.optimal; };
  for (const bool is_maximum : {false, true}) {
    std::vector<std::int64_t> objectives;
    for (std::int64_t objective = is_maximum ? 1 : 0; objective < table.count(); objective += 2) {
      if (table[objective].wanted) objectives.push_back(objective);
    }
    const auto task = [&](std::int64_t objective) {
      const std::int64_t minimum = objective - 1;
      const bool from_minimum =
          is_maximum && options.start == WalkStart::kMinimum && std::as_const(table)[minimum].optimal;
      return walk_to_value(search, checker, objective, from_minimum ? table.best_basis(minimum) : start);
    };
    rounds.run_independent(objectives, task, close);
  }
}

}  // namespace indet
