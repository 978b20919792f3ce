#include "libindet/range/interval_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <numeric>
#include <optional>
#include <thread>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/sensitivity.h"

namespace indet {
namespace {

class IntervalSearch {
 public:
  IntervalSearch(const ForcePolytope& polytope, std::span<const barrier::Objective> objectives,
                 const IntervalOptions& options, const std::vector<bool>& keeps_proof)
      : polytope_(polytope),
        central_(*polytope.central),
        objectives_(objectives),
        options_(options),
        keeps_proof_(keeps_proof),
        least_(1 / polytope.problem.units.internal_in_weights()),
        intervals_(objectives.size(), ValueInterval{-kInfinity, kInfinity, kNaN, 0, {}, {}}) {}

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

  /// Searches these objectives on all threads, the calling one among them.
  void search(const std::vector<std::size_t>& wanted, double share, double least_aim) {
    if (wanted.empty()) return;
    std::atomic<std::size_t> next = 0;
    barrier::LockStepOptions lock_step;
    lock_step.gap = share * options_.gap;
    lock_step.least = least_;
    lock_step.least_aim = least_aim;
    const auto run = [&](bool is_calling_thread) {
      barrier::minimise_in_lock_step(
          central_.structure, central_.centre, lock_step,
          {.next = [&]() -> std::optional<std::size_t> {
             const std::size_t k = next++;
             return k < wanted.size() ? std::optional(wanted[k]) : std::nullopt;
           },
           .objective = [&](std::size_t k) -> const barrier::Objective& { return objectives_[k]; },
           .finish = [&](const barrier::Iterate& iterate) { settle(iterate); },
           .keep_on = [&] { return is_wanted(is_calling_thread); }});
    };
    const auto guarded = [&](bool is_calling_thread) {
      try {
        run(is_calling_thread);
      } catch (...) {
        if (!stopped_.exchange(true)) failure_ = std::current_exception();
      }
    };
    {
      std::vector<std::jthread> others;
      const auto lanes = static_cast<std::size_t>(std::max(1, options_.threads));
      const std::size_t useful = std::min(lanes, (wanted.size() + 7) / 8);
      for (std::size_t k = 1; k < useful; ++k) others.emplace_back(guarded, false);
      guarded(true);
    }
    if (failure_) std::rethrow_exception(failure_);
    if (stopped_) throw Interrupted();
  }

  bool is_wanted(bool is_calling_thread) {
    if (is_calling_thread && options_.progress &&
        !options_.progress(settled_, static_cast<std::int64_t>(objectives_.size())))
      stopped_ = true;
    return !stopped_;
  }

  void settle(const barrier::Iterate& iterate) {
    const barrier::Objective& objective = objectives_[iterate.objective];
    const std::vector<double> x = central_.equations->repaired(iterate.x);
    const barrier::ValueBounds bounds = central_.equations->enclose(objective, x, iterate.y);
    ValueInterval& interval = intervals_[iterate.objective];
    interval.iterations += iterate.iterations;
    const bool is_better = bounds.upper - bounds.lower < interval.upper - interval.lower;
    if (is_better || std::isnan(interval.sensitivity)) interval.sensitivity = sensitivity(x, iterate.y);
    if (!keeps_proof_.empty() && keeps_proof_[iterate.objective]) {
      if (interval.y.empty() || bounds.lower > interval.lower)
        interval.y.assign(iterate.y.begin(), iterate.y.end());
      if (interval.x.empty() || bounds.upper < interval.upper) interval.x = x;
    }
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
  const std::vector<bool>& keeps_proof_;
  double least_;  ///< 1 mg in the unit of the problem
  std::vector<ValueInterval> intervals_;
  std::atomic<std::int64_t> settled_ = 0;
  std::atomic<bool> stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<ValueInterval> enclose_least_values(const ForcePolytope& polytope,
                                                std::span<const barrier::Objective> objectives,
                                                const IntervalOptions& options,
                                                const std::vector<bool>& keeps_proof) {
  return IntervalSearch(polytope, objectives, options, keeps_proof).run();
}

}  // namespace indet
