#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "libindet/barrier/lock_step.h"
#include "tests/barrier/sets.h"

namespace indet::test {

/// What was finished for one objective.
struct Run {
  bool finished = false;
  std::vector<double> x, y;
  int iterations = -1;
  bool converged = false;
};

/// One run an objective; those that are not in `order` are not asked for.
inline std::vector<Run> minimise(const StrengthSet& set, const barrier::AnalyticCentre& centre,
                                 const std::vector<barrier::Objective>& objectives,
                                 const std::vector<std::size_t>& order,
                                 const barrier::LockStepOptions& options) {
  std::vector<Run> runs(objectives.size());
  std::size_t next = 0;
  barrier::LockStepCalls calls;
  calls.next = [&]() -> std::optional<std::size_t> {
    if (next < order.size()) return order[next++];
    return std::nullopt;
  };
  calls.objective = [&](std::size_t k) -> const barrier::Objective& { return objectives[k]; };
  calls.finish = [&](const barrier::Iterate& iterate) {
    Run& run = runs[iterate.objective];
    run.finished = true;
    run.x.assign(iterate.x.begin(), iterate.x.end());
    run.y.assign(iterate.y.begin(), iterate.y.end());
    run.iterations = iterate.iterations;
    run.converged = iterate.converged;
  };
  calls.keep_on = [] { return true; };
  minimise_in_lock_step(set.structure, centre, options, calls);
  return runs;
}

}  // namespace indet::test
