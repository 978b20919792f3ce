#include "libindet/range/barrier_ranges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/unbounded_polytope.h"
#include "libindet/range/determined_forces.h"
#include "libindet/range/dual_collector.h"
#include "libindet/range/functional.h"

namespace indet {
namespace {

/// An objective and where its result goes.
struct Target {
  bool is_reaction = false;
  Eigen::Index row = 0;
  int column = 0;
  double sign = 1;      ///< −1: a maximum, of which the objective is the least value with the other sign
  double rounding = 0;  ///< what roundings of the objective's coefficients change at most

  BarrierPreparation::Key key() const { return {is_reaction, row, column}; }
};

bool has_centre(const ForcePolytope& polytope) { return polytope.central || polytope.unbounded; }

const CentralPolytope& centre_of(const ForcePolytope& polytope) {
  return polytope.central ? *polytope.central : *polytope.unbounded->within;
}

class BarrierSearch {
 public:
  /// `contacts`: of the part.
  BarrierSearch(const Packing& packing, const ForcePolytope& polytope, const BarrierPreparation& prepared,
                const std::vector<int>& contacts, const IntervalOptions& options)
      : packing_(packing),
        polytope_(polytope),
        problem_(polytope.problem),
        prepared_(prepared),
        contacts_(contacts),
        is_first_(prepared.contacts.empty() ||
                  (!contacts.empty() && contacts.front() == prepared.contacts.front())),
        options_(options),
        sums_(prepared.reactions && is_first_ ? reaction_sums(packing) : std::vector<ReactionSum>()) {
    prepare();
  }

  BarrierRanges run() {
    if (polytope_.status == PolytopeStatus::kEmpty) return without_states(Outcome::kNotRequested);
    if (!has_centre(polytope_)) return without_states(Outcome::kFailed);
    std::set_intersection(prepared_.with_duals.begin(), prepared_.with_duals.end(), contacts_.begin(),
                          contacts_.end(), std::back_inserter(with_duals_));
    if (!with_duals_.empty()) duals_.emplace(packing_, polytope_, with_duals_);
    list_objectives();
    if (polytope_.unbounded) take_out_unbounded();
    std::vector<bool> keeps_proof;
    for (const Target& target : targets_) keeps_proof.push_back(has_duals(target));
    std::vector<ValueInterval> intervals =
        polytope_.unbounded
            ? enclose_within_limits(*polytope_.unbounded)
            : enclose_least_values(problem_, *polytope_.central, *polytope_.central->equations, objectives_,
                                   options_, keeps_proof);
    for (std::size_t k = 0; k < targets_.size(); ++k) store(targets_[k], std::move(intervals[k]));
    finish_reactions();
    if (duals_) result_.duals = duals_->take();
    if (result_.duals.are_kept()) result_.duals.seed = prepared_.dual_seed;
    return std::move(result_);
  }

  /// Looks for the objectives that grow without limit, and does nothing else.
  void find_rays(BarrierPreparation& found) {
    list_objectives();
    found.growth = find_growth(*polytope_.unbounded, problem_, objectives_, options_);
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      if (const int ray = found.growth.ray[k]; ray >= 0) found.ray_of[targets_[k].key()] = ray;
    }
  }

 private:
  /// The method has no values.
  BarrierRanges without_states(Outcome outcome) {
    for (const int i : contacts_) result_.extrema.claim.row(i) = outcome;
    result_.reactions.outcome.setConstant(outcome);
    for (std::size_t k = 0; k < sums_.size(); ++k) describe(k);
    return std::move(result_);
  }

  void describe(std::size_t k) {
    result_.reactions.body[static_cast<Eigen::Index>(k)] = sums_[k].body.code();
    result_.reactions.component[static_cast<Eigen::Index>(k)] = sums_[k].component;
  }

  void prepare() {
    const auto count = static_cast<Eigen::Index>(problem_.contacts.size());
    Extrema& extrema = result_.extrema;
    extrema.method = Method::kBarrier;
    extrema.state_kind = StateChoice::Kind::kNone;
    extrema.claim.setConstant(count, 4, Outcome::kNotRequested);
    extrema.vertex.setConstant(count, 4, -1);
    extrema.unique.setZero(count, 4);
    extrema.ray.setConstant(count, 4, -1);
    for (auto* table :
         {&extrema.value, &extrema.primal_residual, &extrema.dual_residual, &extrema.ray_residual})
      table->setConstant(count, 4, kNaN);
    extrema.states.resize(0, 2 * count);
    extrema.rays.resize(0, 2 * count);
    extrema.active.resize(0, std::max(0, polytope_.dim));
    extrema.gap = options_.gap;
    Enclosures& enclosures = result_.enclosures;
    for (auto* table : {&enclosures.lower, &enclosures.upper}) table->setConstant(count, 4, kNaN);
    enclosures.sensitivity.clear(count);
    enclosures.proven = !polytope_.doubtful;
    Reactions& reactions = result_.reactions;
    const auto sums = static_cast<Eigen::Index>(sums_.size());
    reactions.body.resize(sums);
    reactions.component.resize(sums);
    for (auto* table : {&reactions.value, &reactions.lower, &reactions.upper})
      table->setConstant(sums, 2, kNaN);
    reactions.outcome.setConstant(sums, 2, Outcome::kFailed);
    reactions.vertex.setConstant(sums, 2, -1);
    reactions.ray.setConstant(sums, 2, -1);
    reactions.states.resize(0, 2 * count);
    reactions.rays.resize(0, 2 * count);
  }

  void add(const Target& target, barrier::Objective objective) {
    std::erase_if(objective, [](const auto& entry) { return entry.second == 0; });
    if (objective.empty()) return store(target, {0, 0, 0, 0, {}, {}});
    for (auto& [column, weight] : objective) weight *= target.sign;
    targets_.push_back(target);
    objectives_.push_back(std::move(objective));
  }

  void list_objectives() {
    list_contacts();
    list_reactions();
  }

  void list_contacts() {
    const DeterminedForces determined(problem_, centre_of(polytope_));
    const std::vector<int> first = problem_.first_unknowns();
    for (const int i : contacts_) {
      for (const bool tangential : {false, true}) {
        barrier::Objective objective = force_component(problem_, first, i, tangential, 1);
        std::erase_if(objective, [](const auto& entry) { return entry.second == 0; });
        const Target least{false, i, tangential ? kMinT : kMinR};
        const Target largest{false, i, tangential ? kMaxT : kMaxR, -1};
        for (const Target& target : {least, largest})
          result_.extrema.claim(i, target.column) = Outcome::kEnclosed;
        if (store_determined(determined, objective, least, largest)) {
          result_.extrema.determined += 2;
        } else {
          add(least, objective);
          add(largest, std::move(objective));
        }
      }
    }
  }

  /// Returns whether the force is the same in all states, and its value proven without a search.
  bool store_determined(const DeterminedForces& determined, const barrier::Objective& objective,
                        const Target& least, const Target& largest) {
    ValueInterval interval{0, 0, 0, 0, {}, {}};
    if (!objective.empty()) {
      const bool may_vary =
          polytope_.dim > 0 && !is_determined(packing_, prepared_.widths, least.row, least.column == kMinT);
      if (may_vary) return false;
      const auto total = static_cast<std::int64_t>(4 * contacts_.size());
      if (options_.progress && !options_.progress(0, total)) throw Interrupted();
      interval = determined.enclose(objective);
      if (!determined.is_proof(interval, options_.gap)) return false;
    }
    ValueInterval opposite = interval;
    opposite.lower = -interval.upper;
    opposite.upper = -interval.lower;
    for (double& y : opposite.y) y = -y;
    store(least, std::move(interval));
    store(largest, std::move(opposite));
    return true;
  }

  void list_reactions() {
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      const ReactionSum& sum = sums_[k];
      const auto row = static_cast<Eigen::Index>(k);
      describe(k);
      const double rounding =
          polytope_.central
              ? rounding_of_sum(problem_, sum.coefficients, polytope_.central->equations->strength_bounds())
              : 0;
      for (const int end : {0, 1})
        add({true, row, end, end == 0 ? 1.0 : -1.0, rounding}, sum_of_forces(problem_, sum.coefficients));
    }
  }

  /// Notes what grows without limit, and leaves the other objectives.
  void take_out_unbounded() {
    const Growth& growth = prepared_.growth;
    if (is_first_) {
      result_.extrema.pivots += growth.iterations;
      result_.extrema.solves += growth.searches;
    }
    std::vector<Target> targets;
    std::vector<barrier::Objective> objectives;
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      const auto ray = prepared_.ray_of.find(targets_[k].key());
      if (ray == prepared_.ray_of.end()) {
        targets.push_back(targets_[k]);
        objectives.push_back(std::move(objectives_[k]));
      } else {
        store_ray(targets_[k], ray->second, growth.rays[static_cast<std::size_t>(ray->second)]);
      }
    }
    targets_ = std::move(targets);
    objectives_ = std::move(objectives);
  }

  void store_ray(const Target& target, int number, const Eigen::VectorXd& strengths) {
    std::map<int, std::int32_t>& known = target.is_reaction ? reaction_rays_ : force_rays_;
    Rows<double>& rays = target.is_reaction ? result_.reactions.rays : result_.extrema.rays;
    const auto [entry, is_new] = known.emplace(number, static_cast<std::int32_t>(rays.rows()));
    if (is_new) {
      const Eigen::VectorXd ray = problem_.state(strengths).value();
      rays.conservativeResize(rays.rows() + 1, Eigen::NoChange);
      rays.bottomRows(1) = ray.transpose() / ray.lpNorm<Eigen::Infinity>();
    }
    if (target.is_reaction) {
      const double infinite = -target.sign * kInfinity;
      result_.reactions.ray(target.row, target.column) = entry->second;
      result_.reactions.lower(target.row, target.column) = infinite;
      result_.reactions.upper(target.row, target.column) = infinite;
      return;
    }
    result_.extrema.claim(target.row, target.column) = Outcome::kUnbounded;
    result_.extrema.ray(target.row, target.column) = entry->second;
    result_.extrema.ray_residual(target.row, target.column) =
        (problem_.edge_matrix * strengths).lpNorm<Eigen::Infinity>();
  }

  /// A least value may be attained where some strengths are large, so what comes out too wide is searched
  /// within a wider limit again.
  std::vector<ValueInterval> enclose_within_limits(const UnboundedPolytope& unbounded) {
    std::vector<ValueInterval> intervals(objectives_.size());
    std::vector<std::size_t> wide(objectives_.size());
    std::iota(wide.begin(), wide.end(), std::size_t{0});
    for (const double factor : {0.0, 1e1, 1e3, 1e5}) {
      const auto within = factor > 0 ? limited_polytope(problem_, unbounded, factor) : unbounded.within;
      if (wide.empty() || !within->centre.found) break;
      std::vector<barrier::Objective> objectives;
      for (const std::size_t k : wide) objectives.push_back(objectives_[k]);
      const std::vector<ValueInterval> found =
          enclose_least_values(problem_, *within, *unbounded.within->equations, objectives, options_);
      for (std::size_t k = 0; k < wide.size(); ++k) intervals[wide[k]].meet(found[k]);
      std::erase_if(wide, [&](std::size_t k) { return is_narrow(intervals[k], problem_, options_.gap); });
    }
    return intervals;
  }

  bool has_duals(const Target& target) const {
    return !target.is_reaction && std::binary_search(with_duals_.begin(), with_duals_.end(), target.row);
  }

  void store(const Target& target, ValueInterval interval) {
    if (has_duals(target))
      duals_->add(static_cast<int>(target.row), target.column, std::move(interval.x), interval.y);
    interval.lower -= target.rounding;
    interval.upper += target.rounding;
    const auto [lower, upper] = value_bounds({interval.lower, interval.upper}, target.sign, problem_);
    if (target.is_reaction) {
      result_.reactions.lower(target.row, target.column) = lower;
      result_.reactions.upper(target.row, target.column) = upper;
    } else {
      // Contacts do not pull.
      result_.enclosures.lower(target.row, target.column) =
          target.column == kMinR || target.column == kMaxR ? std::max(lower, 0.0) : lower;
      result_.enclosures.upper(target.row, target.column) = upper;
      result_.enclosures.sensitivity.set(target.row, target.column, {interval.sensitivity});
    }
    result_.extrema.pivots += interval.iterations;
    result_.extrema.solves += interval.iterations > 0 ? 1 : 0;
  }

  void finish_reactions() {
    Reactions& r = result_.reactions;
    for (Eigen::Index row = 0; row < r.count(); ++row) {
      for (const int end : {0, 1}) {
        if (r.ray(row, end) >= 0) {
          r.value(row, end) = r.lower(row, end);
          r.outcome(row, end) = Outcome::kUnbounded;
          continue;
        }
        const auto [value, outcome] = enclosed_value(r.lower(row, end), r.upper(row, end), options_.gap,
                                                     problem_.units.weight_in_scene());
        r.value(row, end) = value;
        r.outcome(row, end) = result_.enclosures.proven ? outcome : Outcome::kImprecise;
      }
    }
  }

  const Packing& packing_;
  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const BarrierPreparation& prepared_;
  const std::vector<int>& contacts_;
  bool is_first_;  ///< the part that has what is found once
  const IntervalOptions& options_;
  std::vector<int> with_duals_;  ///< ascending
  std::optional<DualCollector> duals_;
  std::vector<ReactionSum> sums_;
  std::vector<Target> targets_;
  std::vector<barrier::Objective> objectives_;
  std::map<int, std::int32_t> force_rays_, reaction_rays_;  ///< number of a ray in the search, row
  BarrierRanges result_;
};

}  // namespace

BarrierPreparation prepare_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                          std::vector<int> contacts, CentralWidths widths, bool reactions,
                                          const IntervalOptions& options, const DualChoice& duals) {
  BarrierPreparation prepared;
  prepared.contacts = std::move(contacts);
  prepared.reactions = reactions;
  prepared.widths = std::move(widths);
  if (polytope.status == PolytopeStatus::kEmpty || !has_centre(polytope)) return prepared;
  prepared.with_duals = contacts_with_duals(duals, prepared.contacts);
  if (!prepared.with_duals.empty() && !polytope.central)
    throw InputError(
        "some contact forces can grow without limit here, and multipliers that prove values are kept of "
        "packings where all are limited; --duals none leaves them out");
  if (duals.kind == DualChoice::Kind::kSample) prepared.dual_seed = static_cast<std::int64_t>(duals.seed);
  if (prepared.widths.width.rows() == 0)
    prepared.widths = central_widths(polytope.problem, centre_of(polytope));
  if (polytope.unbounded)
    BarrierSearch(packing, polytope, prepared, prepared.contacts, options).find_rays(prepared);
  return prepared;
}

BarrierRanges find_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                  const BarrierPreparation& prepared, const std::vector<int>& contacts,
                                  const IntervalOptions& options) {
  return BarrierSearch(packing, polytope, prepared, contacts, options).run();
}

BarrierRanges find_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                  const std::vector<int>& contacts, const CentralWidths& widths,
                                  bool reactions, const IntervalOptions& options) {
  const BarrierPreparation prepared =
      prepare_barrier_ranges(packing, polytope, contacts, widths, reactions, options);
  return find_barrier_ranges(packing, polytope, prepared, contacts, options);
}

barrier::ValueBounds value_bounds(const barrier::ValueBounds& least, double sign,
                                  const EquilibriumProblem& problem) {
  if (least.lower == 0 && least.upper == 0) return {0, 0};
  const double unit = problem.units.internal_in_scene();
  const auto room = [&](double bound) {
    return bound == 0 ? 0 : unit * (4 * kRoundoff * std::abs(bound) + kTiny);
  };
  const barrier::ValueBounds bounds{least.lower * unit - room(least.lower),
                                    least.upper * unit + room(least.upper)};
  return sign < 0 ? barrier::ValueBounds{-bounds.upper, -bounds.lower} : bounds;
}

EnclosedValue enclosed_value(double lower, double upper, double gap, double weight) {
  if (!std::isfinite(lower) || !std::isfinite(upper)) return {kNaN, Outcome::kFailed};
  const double value = lower + (upper - lower) / 2;
  const double size = std::max(weight, std::abs(value));
  return {value, upper - lower <= gap * size ? Outcome::kEnclosed : Outcome::kImprecise};
}

}  // namespace indet
