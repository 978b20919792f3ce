#include "libindet/range/interval_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/lock_step_team.h"
#include "libindet/range/sensitivity.h"

namespace indet {
namespace {

class IntervalSearch {
 public:
  IntervalSearch(const ForcePolytope& polytope, std::span<const barrier::Objective> objectives,
                 const IntervalOptions& options)
      : polytope_(polytope),
        central_(*polytope.central),
        objectives_(objectives),
        options_(options),
        least_(1 / polytope.problem.units.internal_in_weights()),
        intervals_(objectives.size(), ValueInterval{-kInfinity, kInfinity, kNaN, 0}) {}

  std::vector<ValueInterval> run() {
    std::vector<std::size_t> wanted(objectives_.size());
    std::iota(wanted.begin(), wanted.end(), std::size_t{0});
    // A part of the width is left for what the repair and the proofs cost.
    for (const auto& [share, least_aim] : {std::pair(0.5, 1e-8), {0.5, 0.1}, {0.25, 0.3}}) {
      search(wanted, share, least_aim);
      std::erase_if(wanted, [&](std::size_t k) { return is_narrow(intervals_[k]); });
      settled_ -= static_cast<std::int64_t>(wanted.size());
    }
    const auto total = static_cast<std::int64_t>(objectives_.size());
    if (options_.progress && !options_.progress(total, total)) throw Interrupted();
    return std::move(intervals_);
  }

 private:
  bool is_narrow(const ValueInterval& interval) const {
    const double size = std::max(least_, std::min(std::abs(interval.lower), std::abs(interval.upper)));
    return interval.upper - interval.lower <= options_.gap * size;
  }

  void search(const std::vector<std::size_t>& wanted, double share, double least_aim) {
    barrier::LockStepOptions lock_step;
    lock_step.gap = share * options_.gap;
    lock_step.least = least_;
    lock_step.least_aim = least_aim;
    const auto total = static_cast<std::int64_t>(objectives_.size());
    minimise_on_threads(
        central_.structure, central_.centre, lock_step, wanted, options_.threads,
        {.objective = [&](std::size_t k) -> const barrier::Objective& { return objectives_[k]; },
         .finish = [&](const barrier::Iterate& iterate) { settle(iterate); },
         .keep_on = [&] { return !options_.progress || options_.progress(settled_, total); }});
  }

  void settle(const barrier::Iterate& iterate) {
    const barrier::Objective& objective = objectives_[iterate.objective];
    const std::vector<double> x = central_.equations->repaired(iterate.x);
    const barrier::ValueBounds bounds = central_.equations->enclose(objective, x, iterate.y);
    ValueInterval& interval = intervals_[iterate.objective];
    interval.iterations += iterate.iterations;
    const bool is_better = bounds.upper - bounds.lower < interval.upper - interval.lower;
    if (is_better || std::isnan(interval.sensitivity)) interval.sensitivity = sensitivity(x, iterate.y);
    interval.lower = std::max(interval.lower, bounds.lower);
    interval.upper = std::min(interval.upper, bounds.upper);
    ++settled_;
  }

  double sensitivity(const std::vector<double>& x, std::span<const double> y) const {
    const EquilibriumProblem& problem = polytope_.problem;
    const Eigen::VectorXd motion = on_equations(problem, central_.structure, y);
    const Eigen::Map<const Eigen::VectorXd> strengths(x.data(), static_cast<Eigen::Index>(x.size()));
    return sensitivity_to_normals(problem, motion, problem.units.scene(problem.state(strengths)));
  }

  const ForcePolytope& polytope_;
  const CentralPolytope& central_;
  std::span<const barrier::Objective> objectives_;
  const IntervalOptions& options_;
  double least_;  ///< 1 mg in the unit of the problem
  std::vector<ValueInterval> intervals_;
  std::atomic<std::int64_t> settled_ = 0;
};

}  // namespace

std::vector<ValueInterval> enclose_least_values(const ForcePolytope& polytope,
                                                std::span<const barrier::Objective> objectives,
                                                const IntervalOptions& options) {
  return IntervalSearch(polytope, objectives, options).run();
}

}  // namespace indet
