#include "libindet/range/growth_search.h"

#include <algorithm>
#include <map>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/range/lock_step_run.h"

namespace indet {
namespace {

class GrowthSearch {
 public:
  GrowthSearch(const UnboundedPolytope& polytope, const EquilibriumProblem& problem,
               std::span<const barrier::Objective> objectives, const IntervalOptions& options)
      : polytope_(polytope), equations_(*polytope.cone.equations), problem_(problem), options_(options) {
    growth_.ray.assign(objectives.size(), -1);
    for (const barrier::Objective& objective : objectives) objectives_.push_back(on_cone(objective));
    for (std::size_t k = 0; k < objectives.size(); ++k) {
      const bool can_fall = std::any_of(objectives_[k].begin(), objectives_[k].end(),
                                        [](const auto& entry) { return entry.second < 0; });
      if (can_fall) open_.push_back(k);
    }
  }

  Growth run() {
    try_ray(polytope_.cone.centre.x);
    search_together();
    while (!open_.empty()) search_some();
    return std::move(growth_);
  }

 private:
  /// Objectives that are searched for at a time, whatever the number of threads.
  static constexpr std::size_t kRound = 32;
  /// Those of all objectives together go on as long as each settles this share of them.
  static constexpr std::size_t kWorthwhile = 8;

  barrier::Objective on_cone(const barrier::Objective& objective) const {
    barrier::Objective result;
    for (const auto& [edge, weight] : objective) {
      const auto at = std::lower_bound(polytope_.unlimited.begin(), polytope_.unlimited.end(), edge);
      if (at != polytope_.unlimited.end() && *at == edge)
        result.emplace_back(static_cast<int>(at - polytope_.unlimited.begin()), weight);
    }
    return result;
  }

  /// Settles all objectives that are proven to fall along the ray near r, and notes it if there are any.
  void try_ray(std::vector<double> r) {
    const barrier::NearestSolution nearest = equations_.nearest_solution(r);
    // The point that the bound belongs to, but for its distance to the exact one.
    const std::vector<double>& centre = polytope_.cone.centre.x;
    for (std::size_t k = 0; k < r.size(); ++k)
      r[k] = std::max(0.0, r[k] + nearest.share * (centre[k] - r[k]));
    const double least = tolerance::kRay * static_cast<double>(polytope_.unlimited.size());
    const auto falls = [&](std::size_t k) {
      return equations_.upper_bound(objectives_[k], r, nearest) < -least;
    };
    const int number = static_cast<int>(growth_.rays.size());
    const auto count = open_.size();
    std::erase_if(open_, [&](std::size_t k) {
      if (!falls(k)) return false;
      growth_.ray[k] = number;
      return true;
    });
    if (open_.size() == count) return;
    Eigen::VectorXd ray = Eigen::VectorXd::Zero(problem_.unknowns());
    for (std::size_t k = 0; k < polytope_.unlimited.size(); ++k) ray[polytope_.unlimited[k]] = r[k];
    growth_.rays.push_back(ray / ray.maxCoeff());
  }

  std::vector<std::vector<double>> minimise(std::span<const barrier::Objective> objectives,
                                            const std::vector<std::size_t>& wanted) {
    std::vector<std::vector<double>> points(objectives.size());
    std::vector<int> iterations(objectives.size(), 0);
    barrier::LockStepOptions lock_step;
    const auto total = static_cast<std::int64_t>(growth_.ray.size());
    run_in_lock_step(polytope_.cone.structure, polytope_.cone.centre, wanted,
                     {.options = lock_step,
                      .threads = options_.threads,
                      .objective = [&](std::size_t k) { return objectives[k]; },
                      .finish =
                          [&](const barrier::Iterate& iterate) {
                            points[iterate.objective] = equations_.repaired(iterate.x);
                            iterations[iterate.objective] = iterate.iterations;
                          },
                      .keep_on = [&] { return !options_.progress || options_.progress(0, total); }});
    for (const std::size_t k : wanted) growth_.iterations += iterations[k];
    growth_.searches += static_cast<std::int64_t>(wanted.size());
    return points;
  }

  void search_together() {
    std::size_t before = 0;
    do {
      before = open_.size();
      std::map<int, double> sum;
      for (const std::size_t k : open_) {
        for (const auto& [edge, weight] : objectives_[k]) sum[edge] += weight;
      }
      std::vector<barrier::Objective> all(1);
      for (const auto& [edge, weight] : sum) {
        if (weight != 0) all.front().emplace_back(edge, weight);
      }
      if (all.front().empty()) return;
      try_ray(std::move(minimise(all, {0}).front()));
    } while (before - open_.size() > before / kWorthwhile);
  }

  void search_some() {
    const std::vector<std::size_t> round(
        open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(std::min(kRound, open_.size())));
    std::vector<std::vector<double>> points = minimise(objectives_, round);
    for (const std::size_t k : round) {
      if (growth_.ray[k] >= 0) continue;
      try_ray(std::move(points[k]));
    }
    // Those that do not fall along their own ray fall along none.
    std::erase_if(open_, [&](std::size_t k) { return std::binary_search(round.begin(), round.end(), k); });
  }

  const UnboundedPolytope& polytope_;
  const barrier::VerifiedEquations& equations_;
  const EquilibriumProblem& problem_;
  const IntervalOptions& options_;
  std::vector<barrier::Objective> objectives_;
  std::vector<std::size_t> open_;  ///< ascending
  Growth growth_;
};

}  // namespace

Growth find_growth(const UnboundedPolytope& polytope, const EquilibriumProblem& problem,
                   std::span<const barrier::Objective> objectives, const IntervalOptions& options) {
  return GrowthSearch(polytope, problem, objectives, options).run();
}

}  // namespace indet
