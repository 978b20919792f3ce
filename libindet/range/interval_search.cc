#include "libindet/range/interval_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/lock_step_run.h"
#include "libindet/range/sensitivity.h"

namespace indet {
namespace {

class IntervalSearch {
 public:
  IntervalSearch(const EquilibriumProblem& problem, const CentralPolytope& central,
                 const barrier::VerifiedEquations& equations, std::span<const barrier::Objective> objectives,
                 const IntervalOptions& options, const std::vector<bool>& keeps_proof)
      : problem_(problem),
        central_(central),
        equations_(equations),
        objectives_(objectives),
        options_(options),
        keeps_proof_(keeps_proof),
        least_(1 / problem.units.internal_in_weights()),
        intervals_(objectives.size()) {}

  std::vector<ValueInterval> run() {
    std::vector<std::size_t> wanted(objectives_.size());
    std::iota(wanted.begin(), wanted.end(), std::size_t{0});
    // A part of the width is left for what the repair and the proofs cost.
    for (const auto& [share, least_aim] : {std::pair(0.5, 1e-8), {0.5, 0.1}, {0.25, 0.3}}) {
      search(wanted, share, least_aim);
      std::erase_if(wanted, [&](std::size_t k) { return is_narrow(intervals_[k], problem_, options_.gap); });
      settled_ -= static_cast<std::int64_t>(wanted.size());
    }
    const auto total = static_cast<std::int64_t>(objectives_.size());
    if (options_.progress && !options_.progress(total, total)) throw Interrupted();
    return std::move(intervals_);
  }

 private:
  void search(const std::vector<std::size_t>& wanted, double share, double least_aim) {
    barrier::LockStepOptions lock_step;
    lock_step.gap = share * options_.gap;
    lock_step.least = least_;
    lock_step.least_aim = least_aim;
    run_in_lock_step(central_.structure, central_.centre, wanted,
                     {.options = lock_step,
                      .threads = options_.threads,
                      .objective = [&](std::size_t k) { return objectives_[k]; },
                      .finish = [&](const barrier::Iterate& iterate) { settle(iterate); },
                      .keep_on =
                          [&] {
                            return !options_.progress ||
                                   options_.progress(settled_, static_cast<std::int64_t>(objectives_.size()));
                          }});
  }

  void settle(const barrier::Iterate& iterate) {
    const barrier::Objective& objective = objectives_[iterate.objective];
    std::vector<double> x = equations_.repaired(iterate.x);
    const barrier::ValueBounds bounds = equations_.enclose(objective, x, iterate.y);
    ValueInterval found{bounds.lower, bounds.upper, sensitivity(x, iterate.y), iterate.iterations, {}, {}};
    if (!keeps_proof_.empty() && keeps_proof_[iterate.objective]) {
      found.x = std::move(x);
      found.y.assign(iterate.y.begin(), iterate.y.end());
    }
    intervals_[iterate.objective].meet(found);
    ++settled_;
  }

  double sensitivity(const std::vector<double>& x, std::span<const double> y) const {
    const Eigen::VectorXd motion = on_equations(problem_, central_.structure, y);
    // A limit has a slack more.
    const Eigen::Map<const Eigen::VectorXd> strengths(x.data(), problem_.unknowns());
    return sensitivity_to_normals(problem_, motion, problem_.units.scene(problem_.state(strengths)));
  }

  const EquilibriumProblem& problem_;
  const CentralPolytope& central_;
  const barrier::VerifiedEquations& equations_;
  std::span<const barrier::Objective> objectives_;
  const IntervalOptions& options_;
  const std::vector<bool>& keeps_proof_;
  double least_;  ///< 1 mg in the unit of the problem
  std::vector<ValueInterval> intervals_;
  std::atomic<std::int64_t> settled_ = 0;
};

}  // namespace

IntervalOptions interval_options(double gap, int threads, const ProgressCallback& progress,
                                 const char* stage) {
  IntervalOptions options{gap, threads, {}};
  if (progress) {
    options.progress = [progress, stage](std::int64_t settled, std::int64_t total) {
      return progress({stage, settled, total, {}});
    };
  }
  return options;
}

void ValueInterval::meet(const ValueInterval& other) {
  const bool is_better = other.upper - other.lower < upper - lower;
  if (is_better || std::isnan(sensitivity)) sensitivity = other.sensitivity;
  if (!other.y.empty() && (y.empty() || other.lower > lower)) y = other.y;
  if (!other.x.empty() && (x.empty() || other.upper < upper)) x = other.x;
  lower = std::max(lower, other.lower);
  upper = std::min(upper, other.upper);
  iterations += other.iterations;
}

bool is_narrow(const ValueInterval& interval, const EquilibriumProblem& problem, double gap) {
  const double weight = 1 / problem.units.internal_in_weights();
  const double size = std::max(weight, std::min(std::abs(interval.lower), std::abs(interval.upper)));
  const double width = interval.upper - interval.lower;
  return std::isfinite(width) && width <= gap * size;
}

std::vector<ValueInterval> enclose_least_values(const EquilibriumProblem& problem,
                                                const CentralPolytope& central,
                                                const barrier::VerifiedEquations& equations,
                                                std::span<const barrier::Objective> objectives,
                                                const IntervalOptions& options,
                                                const std::vector<bool>& keeps_proof) {
  return IntervalSearch(problem, central, equations, objectives, options, keeps_proof).run();
}

}  // namespace indet
