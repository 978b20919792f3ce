#include "libindet/range/central_states.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "libindet/barrier/lexicographic_vertex.h"
#include "libindet/base/random.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/base/tolerances.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/attained_values.h"
#include "libindet/range/functional.h"
#include "libindet/range/lock_step_run.h"
#include "libindet/range/sensitivity_bounds.h"

namespace indet {
namespace {

/// One search of all states that are not found yet: a basis that is not proven best in one often is in
/// another.
struct Round {
  double delta = 0;      ///< weight of ΣR beside the value
  double shift = 0;      ///< of b: as if strengths of the centre grew by up to this share
  double least_aim = 0;  ///< LockStepOptions::least_aim
};
constexpr Round kRounds[] = {{1e-8, 1e-4, 0.01}, {1e-8, 1e-6, 0.1}, {1e-9, 1e-5, 0.1}};
constexpr double kGap = 1e-12;      ///< of the interior point method
constexpr double kTieBreak = 1e-2;  ///< weight of the generic functional beside ΣR

/// A value and the objective whose least value it is, up to its sign.
struct WantedState {
  Eigen::Index contact = 0;
  int column = 0;
  double sign = 1;
  barrier::Objective value;
  bool is_determined = false;  ///< its interval is that of the force's other end, too
};

class StateSearch {
 public:
  StateSearch(const Packing& packing, const ForcePolytope& polytope, const std::vector<int>& contacts,
              const IntervalOptions& options, BarrierRanges& found)
      : packing_(packing),
        polytope_(polytope),
        problem_(polytope.problem),
        central_(*polytope.central),
        options_(options),
        found_(found),
        sensitivity_(polytope, found.extrema.value) {
    Random random(1);
    for (int k = 0; k < problem_.unknowns(); ++k) {
      normal_.push_back(problem_.edge(k).R);
      generic_.push_back(random.uniform(1, 2));
    }
    list_targets(contacts);
    vertices_.resize(targets_.size());
  }

  void run() {
    for (const Round& round : kRounds) {
      std::vector<std::size_t> wanted;
      for (std::size_t t = 0; t < targets_.size(); ++t) {
        if (!vertices_[t]) wanted.push_back(t);
      }
      if (wanted.empty()) break;
      settled_ = static_cast<std::int64_t>(targets_.size() - wanted.size());
      search(round, wanted);
    }
    store();
  }

 private:
  void list_targets(const std::vector<int>& contacts) {
    const std::vector<int> first = problem_.first_unknowns();
    for (const int i : contacts) {
      for (int column = 0; column < 4; ++column) {
        if (found_.extrema.claim(i, column) != Outcome::kEnclosed) continue;
        const double sign = column == kMaxR || column == kMaxT ? -1 : 1;
        const int other = column % 2 == 0 ? column + 1 : column - 1;
        const auto agree = [&](const Table4<double>& ends) { return ends(i, column) == ends(i, other); };
        WantedState target{i, column, sign, force_component(problem_, first, i, column >= kMinT, sign),
                           agree(found_.enclosures.lower) && agree(found_.enclosures.upper)};
        std::erase_if(target.value, [](const auto& entry) { return entry.second == 0; });
        targets_.push_back(std::move(target));
      }
    }
  }

  void search(const Round& round, const std::vector<std::size_t>& wanted) {
    const barrier::BlockStructure shifted = shifted_structure(round.shift);
    barrier::LockStepOptions lock_step;
    lock_step.gap = kGap;
    lock_step.least = 1 / problem_.units.internal_in_weights();
    lock_step.least_aim = round.least_aim;
    run_in_lock_step(shifted, central_.centre, wanted,
                     {.options = lock_step,
                      .threads = options_.threads,
                      .objective = [&](std::size_t t) { return objective_of(targets_[t], round.delta); },
                      .finish =
                          [&](const barrier::Iterate& iterate) {
                            settle(iterate, objective_of(targets_[iterate.objective], round.delta), shifted);
                          },
                      .keep_on = [&] { return keep_on(); }});
  }

  /// On every thread, since a vertex can be seconds away.
  bool keep_on() {
    const bool may_ask = options_.progress && std::this_thread::get_id() == caller_;
    if (may_ask && !options_.progress(settled_, static_cast<std::int64_t>(targets_.size()))) stopped_ = true;
    return !stopped_;
  }

  /// c + δ (g + ε h); where there is no c, because the value is 0 everywhere, the last alone.
  barrier::Objective objective_of(const WantedState& target, double delta) const {
    const double share = target.value.empty() ? 1 : delta;
    barrier::Objective objective;
    for (std::size_t k = 0; k < normal_.size(); ++k)
      objective.emplace_back(static_cast<int>(k), share * (normal_[k] + kTieBreak * generic_[k]));
    for (const auto& [column, weight] : target.value)
      objective[static_cast<std::size_t>(column)].second += weight;
    return objective;
  }

  barrier::BlockStructure shifted_structure(double shift) const {
    Random random(2);
    std::vector<double> more = central_.centre.x;
    for (double& strength : more) strength *= shift * random.uniform();
    std::vector<double> load = barrier::product(central_.structure, more);
    for (std::size_t i = 0; i < load.size(); ++i) load[i] += central_.structure.load()[i];
    return central_.structure.with_load(std::move(load));
  }

  /// Takes the columns of largest x / s as the basis.
  void settle(const barrier::Iterate& iterate, const barrier::Objective& objective,
              const barrier::BlockStructure& shifted) {
    std::vector<double> rank = barrier::transposed_product(central_.structure, iterate.y);
    for (const auto& [column, weight] : objective) {
      const auto k = static_cast<std::size_t>(column);
      rank[k] = iterate.x[k] / std::max(weight - rank[k], kTiny);
    }
    const WantedState& target = targets_[iterate.objective];
    std::vector<std::vector<double>> costs{std::vector<double>(normal_.size(), 0), normal_, generic_};
    for (const auto& [column, weight] : target.value) costs[0][static_cast<std::size_t>(column)] = weight;
    barrier::BasisVertex basis(central_.structure);
    int steps = 0;
    if (basis.set_basis(rank)) {
      auto vertex =
          barrier::find_lexicographic_vertex(basis, costs, central_.structure.load(), shifted.load(),
                                             {.keep_on = [this] { return keep_on(); }, .steps = steps});
      if (vertex) {
        vertices_[iterate.objective] = std::move(vertex);
        ++settled_;
      }
    }
    iterations_ += iterate.iterations + steps;
  }

  /// Each state once, in the order of the values.
  void store() {
    Extrema& extrema = found_.extrema;
    std::map<std::vector<int>, std::int32_t> rows;
    std::vector<std::size_t> first;  // target of each row
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (!vertices_[t]) continue;
      const auto [entry, is_new] =
          rows.emplace(vertices_[t]->closed, static_cast<std::int32_t>(first.size()));
      if (is_new) first.push_back(t);
      extrema.vertex(targets_[t].contact, targets_[t].column) = entry->second;
      note(targets_[t], *vertices_[t]);
      if (!is_new) vertices_[t].reset();
    }
    const auto count = static_cast<Eigen::Index>(first.size());
    extrema.states.resize(count, 2 * static_cast<Eigen::Index>(problem_.contacts.size()));
    extrema.active.resize(count, polytope_.dim);
    for (Eigen::Index row = 0; row < count; ++row) {
      barrier::LexicographicVertex& vertex = *vertices_[first[static_cast<std::size_t>(row)]];
      extrema.states.row(row) = forces_of(vertex).value();
      for (std::size_t k = 0; k < vertex.closed.size(); ++k)
        extrema.active(row, static_cast<Eigen::Index>(k)) =
            problem_.half_plane(problem_.edge(vertex.closed[k]));
      std::sort(extrema.active.row(row).begin(), extrema.active.row(row).end());
      vertex = {};
    }
    note_states(extrema.states, extrema.vertex, StateChecker(packing_), extrema);
    extrema.solves += static_cast<std::int64_t>(targets_.size());
    extrema.pivots += iterations_;
  }

  SceneForces forces_of(const barrier::LexicographicVertex& vertex) const {
    const Eigen::Map<const Eigen::VectorXd> x(vertex.x.data(), std::ssize(vertex.x));
    return problem_.units.scene(problem_.state(x));
  }

  /// What the vertex proves of the value.
  void note(const WantedState& target, const barrier::LexicographicVertex& vertex) {
    found_.extrema.claim(target.contact, target.column) = Outcome::kOptimal;
    found_.extrema.dual_residual(target.contact, target.column) = vertex.dual_residual;
    found_.extrema.unique(target.contact, target.column) = vertex.is_unique ? 1 : 0;
    if (target.value.empty()) return;
    const SceneForces forces = forces_of(vertex);
    const double value = forces.value()[2 * target.contact + (target.column >= kMinT ? 1 : 0)];
    Enclosures& enclosures = found_.enclosures;
    double& stored_lower = enclosures.lower(target.contact, target.column);
    double& stored_upper = enclosures.upper(target.contact, target.column);
    if (!target.is_determined) {
      const auto [lower, upper] =
          value_bounds(central_.equations->enclose(target.value, vertex.x, vertex.y), target.sign, problem_);
      stored_lower = std::max(stored_lower, lower);
      stored_upper = std::min(stored_upper, upper);
    }
    // Rounding of the state can be more than the interval is wide.
    stored_lower = std::min(stored_lower, value);
    stored_upper = std::max(stored_upper, value);
    enclosures.sensitivity.set(target.contact, target.column, sensitivity(target, vertex, forces));
  }

  Sensitivity sensitivity(const WantedState& target, const barrier::LexicographicVertex& vertex,
                          const SceneForces& forces) const {
    const Eigen::VectorXd motion = -on_equations(problem_, central_.structure, vertex.y);
    const double largest = *std::max_element(vertex.x.begin(), vertex.x.end());
    const auto tight = std::count_if(vertex.x.begin(), vertex.x.end(), [&](double x) {
      return x <= tolerance::kTightHalfPlane * std::max(1.0, largest);
    });
    if (vertex.is_unique && tight == std::ssize(vertex.closed))
      return sensitivity_.at_point(target.contact, target.column, motion, forces);
    return {sensitivity_to_normals(problem_, motion, forces)};
  }

  const Packing& packing_;
  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const CentralPolytope& central_;
  const IntervalOptions& options_;
  BarrierRanges& found_;
  SensitivityBounds sensitivity_;
  std::vector<double> normal_, generic_;  ///< g and h
  std::vector<WantedState> targets_;
  std::vector<std::optional<barrier::LexicographicVertex>> vertices_;  ///< of each target
  std::thread::id caller_ = std::this_thread::get_id();  ///< that shows progress, and hears of signals
  std::atomic<bool> stopped_ = false;
  std::atomic<std::int64_t> settled_ = 0, iterations_ = 0;
};

}  // namespace

void add_canonical_states(const Packing& packing, const ForcePolytope& polytope, const StateChoice& kept,
                          const std::vector<int>& contacts, const IntervalOptions& options,
                          BarrierRanges& found) {
  Extrema& extrema = found.extrema;
  extrema.state_kind = kept.kind;
  extrema.states_of = kept.contacts;
  if (!kept.keeps_all())
    extrema.state_contacts = Eigen::Map<const Eigen::ArrayXi>(contacts.data(), std::ssize(contacts));
  StateSearch(packing, polytope, contacts, options, found).run();
}

}  // namespace indet
