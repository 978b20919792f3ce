#include "libindet/range/distance_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

#include "libindet/barrier/state_pairs.h"
#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/base/tolerances.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/range/functional.h"
#include "libindet/range/lock_step_run.h"

namespace indet {
namespace {

/// The ends of a range have to be known well for a shortage to be small.
constexpr double kValueGap = 1e-9;

/// How g of (P), state_pairs.h, is taken: as so many times the distance, as far as that is known, in one pass
/// after the other. What is left with too large a shortage or too wide an interval goes on.
constexpr double kPasses[] = {1e4, 1e5, 1e6, 1e7};
/// The gap at which (P) is left, as a share of 1/g times the distance.
constexpr double kShareOfGap = 3e-5;
/// Of μ that a step aims at at least (LockStepOptions::least_aim): the cautious value of interval searches.
constexpr double kLeastAim = 0.1;

/// A force and what is known of its pairs of states, in the unit of the problem.
struct Candidate {
  int contact = 0;
  int component = 0;  ///< 0 R, 1 T
  barrier::Objective value, opposite;
  barrier::Objective both;  ///< of pairs
  barrier::ValueBounds smallest, largest;
  double g = 0;
  double distance = kInfinity, lower = 0, shortage = kInfinity;

  double size() const { return std::max(std::abs(smallest.lower), std::abs(largest.upper)); }
};

class DistanceSearch {
 public:
  DistanceSearch(const ForcePolytope& polytope, const Certified& certified, const std::vector<int>& contacts,
                 const IntervalOptions& options)
      : problem_(polytope.problem),
        central_(*polytope.central),
        options_(options),
        pairs_(problem_, central_.rows, central_.structure, central_.centre, *central_.equations),
        weight_(1 / problem_.units.internal_in_weights()) {
    list_candidates(certified, contacts);
  }

  std::vector<Candidate> run() {
    total_ = static_cast<std::int64_t>(2 * candidates_.size());
    bound_values();
    std::vector<std::size_t> wanted(candidates_.size());
    std::iota(wanted.begin(), wanted.end(), std::size_t{0});
    for (const double factor : kPasses) {
      search(wanted, factor);
      std::erase_if(wanted, [&](std::size_t k) { return is_known(candidates_[k]); });
      settled_ -= static_cast<std::int64_t>(wanted.size());
    }
    if (options_.progress && !options_.progress(total_, total_)) throw Interrupted();
    std::move(candidates_.begin(), candidates_.end(), std::back_inserter(determined_));
    return std::move(determined_);
  }

  bool is_known(const Candidate& force) const {
    return is_little(force.shortage, force) &&
           std::abs(force.distance - force.lower) <=
               tolerance::kDistanceGap * std::max(weight_, force.distance);
  }

 private:
  bool is_little(double shortage, const Candidate& force) const {
    return shortage <= tolerance::kFaceShortage * std::max(weight_, force.size());
  }

  /// A force that is the same in all states has both faces the same.
  void list_candidates(const Certified& certified, const std::vector<int>& contacts) {
    const std::vector<int> first = problem_.first_unknowns();
    const double unit = problem_.units.internal_in_scene();
    for (const int i : contacts) {
      for (const int component : {0, 1}) {
        Candidate force;
        force.contact = i;
        force.component = component;
        force.value = force_component(problem_, first, i, component == 1, 1);
        std::erase_if(force.value, [](const auto& entry) { return entry.second == 0; });
        for (const auto& [column, coefficient] : force.value)
          force.opposite.emplace_back(column, -coefficient);
        barrier::ValueBounds all{0, 0};
        if (!force.value.empty()) {
          all = central_.equations->enclose_everywhere(force.value,
                                                       central_.equations->nearest_multipliers(force.value));
        }
        if (all.upper - all.lower <= tolerance::kPointRange) {
          force.distance = 0;
          force.shortage = all.upper - all.lower;
          determined_.push_back(std::move(force));
          continue;
        }
        const auto bound = [&](Column column) {
          const double low = certified.lower(i, column) / unit, high = certified.upper(i, column) / unit;
          return barrier::ValueBounds{low - 4 * kRoundoff * std::abs(low),
                                      high + 4 * kRoundoff * std::abs(high)};
        };
        force.smallest = bound(component == 0 ? kMinR : kMinT);
        force.largest = bound(component == 0 ? kMaxR : kMaxT);
        force.both = pairs_.objective(force.value);
        candidates_.push_back(std::move(force));
      }
    }
  }

  /// Narrows the bounds of smallest and largest values.
  void bound_values() {
    std::vector<barrier::Objective> objectives;
    for (const Candidate& force : candidates_) {
      objectives.push_back(force.value);
      objectives.push_back(force.opposite);
    }
    IntervalOptions options = options_;
    options.gap = kValueGap;
    if (options.progress)
      options.progress = [this](std::int64_t settled, std::int64_t) {
        return options_.progress(settled / 2, total_);
      };
    const std::vector<ValueInterval> intervals =
        enclose_least_values(problem_, central_, *central_.equations, objectives, options);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      Candidate& force = candidates_[k];
      const auto narrow = [](barrier::ValueBounds& bounds, double lower, double upper) {
        if (!(bounds.lower >= lower)) bounds.lower = lower;
        if (!(bounds.upper <= upper)) bounds.upper = upper;
      };
      narrow(force.smallest, intervals[2 * k].lower, intervals[2 * k].upper);
      narrow(force.largest, -intervals[2 * k + 1].upper, -intervals[2 * k + 1].lower);
    }
    settled_ = static_cast<std::int64_t>(candidates_.size());
  }

  void search(const std::vector<std::size_t>& wanted, double factor) {
    for (const std::size_t k : wanted) {
      Candidate& force = candidates_[k];
      const double range = force.largest.upper - force.smallest.lower;
      force.g = factor * (force.distance < kInfinity ? std::max(range, force.distance) : range);
    }
    barrier::LockStepOptions lock_step;
    lock_step.gap = kShareOfGap / factor;
    // Where bounds of forces are narrow the unit is small beside 1 mg, and so are distances.
    lock_step.least = std::min(weight_, 1.0);
    lock_step.least_aim = kLeastAim;
    run_in_lock_step(pairs_.structure(), pairs_.centre(), wanted,
                     {.options = lock_step,
                      .threads = options_.threads,
                      .objective = [&](std::size_t k) { return candidates_[k].both; },
                      .finish = [&](const barrier::Iterate& iterate) { settle(iterate); },
                      .keep_on = [&] { return !options_.progress || options_.progress(settled_, total_); },
                      .give = [&](std::size_t k) { return candidates_[k].g; }});
  }

  void settle(const barrier::Iterate& iterate) {
    Candidate& force = candidates_[iterate.objective];
    const barrier::StatePairs::Proof proof = pairs_.prove(force.value, force.g, iterate);
    const double reached = proof.largest - proof.least;
    const double shortage = force.largest.upper - force.smallest.lower - reached;
    // The range is at least what is reached, and what is known of it.
    const double range = std::max(reached, force.largest.lower - force.smallest.upper);
    const double square = 2 * force.g * (proof.dual + range);
    if (square > 0) force.lower = std::max(force.lower, std::sqrt(square) / kWiden);
    // Of states that miss the extremes by little the pair whose distance is next to the bound: a distance
    // that is below shows that even this is too much.
    const bool are_both_little = is_little(shortage, force) && is_little(force.shortage, force);
    const auto beside = [&](double distance) { return std::abs(distance - force.lower); };
    if (are_both_little ? beside(proof.distance) < beside(force.distance) : shortage < force.shortage) {
      force.distance = proof.distance;
      force.shortage = shortage;
    }
    ++settled_;
  }

  const EquilibriumProblem& problem_;
  const CentralPolytope& central_;
  const IntervalOptions& options_;
  barrier::StatePairs pairs_;
  double weight_;  ///< 1 mg in the unit of the problem
  std::vector<Candidate> candidates_, determined_;
  std::int64_t total_ = 0;
  std::atomic<std::int64_t> settled_ = 0;
};

}  // namespace

SmallestDistances find_smallest_distances(const ForcePolytope& polytope, const Certified& certified,
                                          const std::vector<int>& contacts, const IntervalOptions& options) {
  const auto count = certified.value.rows();
  SmallestDistances result;
  for (Eigen::VectorXd* values : {&result.d_R, &result.d_T}) values->setConstant(count, kNaN);
  for (SmallestDistances::Table* table : {&result.lower, &result.shortage})
    table->setConstant(count, 2, kNaN);
  result.outcome.setConstant(count, 2, Outcome::kNotRequested);
  if (polytope.status == PolytopeStatus::kEmpty) return result;
  const auto set = [&](int contact, int component, double distance, double lower, double shortage,
                       Outcome outcome) {
    result.of(component)[contact] = distance;
    result.lower(contact, component) = lower;
    result.shortage(contact, component) = shortage;
    result.outcome(contact, component) = outcome;
  };
  if (!polytope.central || polytope.central->structure.has_limit()) {
    const bool is_point = polytope.status == PolytopeStatus::kPoint && !polytope.doubtful;
    for (const int i : contacts) {
      for (const int component : {0, 1}) {
        if (is_point)
          set(i, component, 0, 0, 0, Outcome::kEnclosed);
        else
          set(i, component, kNaN, kNaN, kNaN, Outcome::kFailed);
      }
    }
    return result;
  }
  DistanceSearch search(polytope, certified, contacts, options);
  const double unit = polytope.problem.units.internal_in_weights();
  for (const Candidate& force : search.run()) {
    const bool is_known = search.is_known(force);
    // Bounds that leave a factor of two tell nothing: proven states are far from where the search ended.
    const bool tells = is_known || 2 * force.lower >= force.distance;
    if (!std::isfinite(force.distance) || !std::isfinite(force.shortage) || !tells) {
      set(force.contact, force.component, kNaN, kNaN, kNaN, Outcome::kFailed);
      continue;
    }
    set(force.contact, force.component, force.distance * unit, force.lower * unit, force.shortage * unit,
        is_known && !polytope.doubtful ? Outcome::kEnclosed : Outcome::kImprecise);
  }
  return result;
}

}  // namespace indet
