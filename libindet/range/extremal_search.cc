#include "libindet/range/extremal_search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/base/worker_team.h"
#include "libindet/pivoting/neighbour_search.h"
#include "libindet/pivoting/tableau_solver.h"

namespace indet {
namespace {

/// Objectives a round. More let more threads work at once, but start from older knowledge: at N = 95, rounds
/// of 2 cost 2 % more pivots than rounds of 1, rounds of 4 cost 12 % (docs/decisions/rounds.md).
constexpr std::size_t kRound = 2;

/// Walks a round: they are independent, so this matters only to memory and to progress.
constexpr std::size_t kWalks = 16;

bool ties(double a, double b) {
  return std::abs(a - b) <= tolerance::kTie * std::max({1.0, std::abs(a), std::abs(b)});
}

/// One objective: component c minimised (even number) or maximised (odd number).
struct Record {
  double best = -std::numeric_limits<double>::infinity();  ///< signed so that larger is better
  double weight = std::numeric_limits<double>::infinity();
  int vertex = -1;
  bool wanted = false;
  bool optimal = false;
  bool canonical = false;
  bool unique = false;
  bool unbounded = false;
  bool failed = false;
  bool stateless = false;  ///< the canonical state was looked for and not found
  double dual_residual = 0;
  std::vector<int> held;
  Basis proof;
};

/// What the solvers had to do.
struct Work {
  std::int64_t solves = 0;
  std::int64_t continued = 0;
  std::int64_t pivots = 0;

  void add(const LpAnswer& answer) {
    ++solves;
    continued += answer.continued ? 1 : 0;
    pivots += answer.pivots;
  }
  void operator+=(const Work& other) {
    solves += other.solves;
    continued += other.continued;
    pivots += other.pivots;
  }
};

class Search {
 public:
  Search(const FeasibleSet& set, const std::vector<Component>& components, const Eigen::VectorXd& weight,
         const SearchOptions& options)
      : set_(set),
        options_(options),
        examiner_(set, components, weight, options.canonical_states),
        walker_(set, tolerance::kSliding),
        records_(2 * components.size()),
        team_(options.threads, [this](int worker) { leave(worker); }) {
    for (std::size_t c = 0; c < components.size(); ++c) {
      records_[2 * c].wanted = components[c].minimise;
      records_[2 * c + 1].wanted = components[c].maximise;
    }
  }

  SearchResult run(const Basis& start) {
    if (options_.method == Method::kPivotingPaper) {
      walk_to_values(start);
    } else {
      merge({visit(start)});
      find_values();
    }
    const auto middle = std::chrono::steady_clock::now();
    if (options_.canonical_states) find_states();
    SearchResult found = result();
    found.state_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
    return found;
  }

 private:
  /// A place in the rounds: its solver, which is always used on the same thread, and the vertex at which it
  /// stands (-1: none that is kept). What a solver answers depends, through rounding, on what it was asked
  /// before, so solvers belong to places, which are as many for any number of threads.
  struct Place {
    std::unique_ptr<Maximiser> solver;
    int vertex = -1;
  };

  /// What a task hands back to the calling thread.
  struct Step {
    std::int64_t objective = -1;
    LpStatus status = LpStatus::kFailed;
    Work work;
    bool settles_state = false;  ///< the vertex is the canonical state of `objective`
    bool unique = false;
    std::optional<Visit> visited;
    std::vector<Finding> findings;
    PaperWork paper;
  };

  /// Ends the solvers of a thread, on that thread.
  void leave(int worker) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (static_cast<int>(i) % team_.workers() == worker) places_[i].solver.reset();
    }
  }

  Maximiser& solver(Place& place) const {
    if (!place.solver && options_.method == Method::kPivotingTableau) {
      place.solver = std::make_unique<TableauSolver>(set_, options_.pivot_rule, options_.lp);
    } else if (!place.solver) {
      place.solver = std::make_unique<LpSolver>(set_, options_.formulation, options_.lp);
    }
    return *place.solver;
  }

  Record& record(std::int64_t objective) { return records_[static_cast<std::size_t>(objective)]; }
  const Record& record(std::int64_t objective) const { return records_[static_cast<std::size_t>(objective)]; }
  static double sign_of(std::int64_t objective) { return Examiner::sign_of(objective); }

  Step visit(const Basis& basis) const {
    Step step;
    step.status = LpStatus::kOptimal;
    Visit visited = examiner_.visit(basis);
    step.findings = examiner_.judge(candidates(visited), visited);
    step.visited = std::move(visited);
    return step;
  }

  /// True if the vertex could improve what is known about an objective whose proof is still open.
  bool is_candidate(std::int64_t objective, double value, double weight) const {
    const Record& known = record(objective);
    if (!known.wanted || known.unbounded || known.failed || known.canonical) return false;
    const double better = sign_of(objective) * value;
    if (!known.optimal && better > known.best) return true;
    if (!ties(better, known.best)) return false;
    return !known.optimal || (options_.canonical_states && weight <= known.weight * (1 + tolerance::kTie));
  }

  std::vector<std::int64_t> candidates(const Visit& visited) const {
    std::vector<std::int64_t> candidates;
    for (std::int64_t objective = 0; objective < examiner_.objectives(); ++objective) {
      if (is_candidate(objective, visited.values[objective / 2], visited.weight))
        candidates.push_back(objective);
    }
    return candidates;
  }

  /// Takes the findings of a round into the records, in the order of the round. Returns the number of the
  /// vertex that each step brought, -1 if it is not kept.
  std::vector<int> merge(std::vector<Step> steps) {
    std::vector<int> ids(steps.size(), -1);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      Step& step = steps[i];
      work_ += step.work;
      paper_ += step.paper;
      if (step.status == LpStatus::kUnbounded) record(step.objective).unbounded = true;
      if (!step.visited) continue;
      const int id = static_cast<int>(vertices_.size());
      bool kept = false;
      for (Finding& finding : step.findings)
        kept = take(finding, step.visited->weight, id, step.visited->vertex.basis) || kept;
      if (step.settles_state) {
        Record& own = record(step.objective);
        own.vertex = id;
        own.weight = step.visited->weight;
        own.canonical = true;
        own.unique = step.unique;
        kept = true;
      }
      if (kept) {
        vertices_.push_back(std::move(step.visited->vertex));
        vertices_.back().active = {};
        ids[i] = id;
      }
    }
    return ids;
  }

  bool take(Finding& finding, double weight, int id, const Basis& basis) {
    Record& known = record(finding.objective);
    if (known.canonical) return false;
    const bool tie = ties(finding.value, known.best);
    const bool lighter = tie && weight < known.weight;
    const bool proves = finding.optimal && !known.optimal && (tie || finding.value > known.best);
    const bool improves = known.optimal ? lighter : (lighter || (!tie && finding.value > known.best));
    const bool completes = tie && finding.canonical;
    if (!proves && !improves && !completes) return false;
    known.best = known.optimal ? known.best : finding.value;
    known.weight = weight;
    known.vertex = id;
    if (!finding.optimal) return true;
    // What a solver merely claims to be optimal does not tell the optimal face.
    if (!known.optimal || known.dual_residual > tolerance::kReducedCost) {
      known.held = std::move(finding.held);
      known.proof = basis;
    }
    known.optimal = true;
    known.dual_residual = finding.dual_residual;
    known.canonical = finding.canonical || !options_.canonical_states;
    known.unique = finding.unique;
    return true;
  }

  /// Runs `work` on the members of a round, each at its place, in parallel, and merges what they found.
  template <class Work>
  void round(const std::vector<std::int64_t>& members, Work work) {
    std::vector<Step> steps(members.size());
    team_.run_pinned(static_cast<std::int64_t>(members.size()), [&](int, std::int64_t i) {
      const auto place = static_cast<std::size_t>(i);
      steps[place] = work(places_[place], members[place]);
    });
    const std::vector<int> ids = merge(std::move(steps));
    for (std::size_t place = 0; place < ids.size(); ++place) places_[place].vertex = ids[place];
    report();
  }

  void report() const {
    if (!options_.progress) return;
    std::int64_t settled = 0;
    std::int64_t total = 0;
    for (const Record& r : records_) {
      if (!r.wanted) continue;
      ++total;
      settled += is_settled(r) ? 1 : 0;
    }
    if (!options_.progress(settled, total)) throw Interrupted();
  }

  bool is_settled(const Record& r) const {
    return r.unbounded || r.failed || r.canonical || (r.optimal && !options_.canonical_states);
  }

  /// The members of the next round: for each place an open objective whose best vertex is the one at which
  /// the solver stands, which saves a factorisation or an exchange of inequalities, else the first open one.
  template <class IsOpen>
  std::vector<std::int64_t> choose_members(IsOpen is_open) {
    std::vector<std::int64_t> members;
    const auto first = [&](auto suits) -> std::int64_t {
      for (std::int64_t objective = first_open_; objective < examiner_.objectives(); ++objective) {
        const Record& r = record(objective);
        const bool is_taken = std::find(members.begin(), members.end(), objective) != members.end();
        if (is_open(r) && !is_taken && suits(r)) return objective;
      }
      return examiner_.objectives();
    };
    first_open_ = first([](const Record&) { return true; });
    for (const Place& place : places_) {
      std::int64_t chosen = first([&](const Record& r) { return r.vertex == place.vertex; });
      if (chosen == examiner_.objectives()) chosen = first([](const Record&) { return true; });
      if (chosen < examiner_.objectives()) members.push_back(chosen);
    }
    return members;
  }

  void find_values() {
    const auto is_open = [](const Record& r) { return r.wanted && !r.optimal && !r.unbounded && !r.failed; };
    first_open_ = 0;
    for (;;) {
      const std::vector<std::int64_t> members = choose_members(is_open);
      if (members.empty()) break;
      round(members, [this](Place& place, std::int64_t objective) { return solve_value(place, objective); });
      for (const std::int64_t objective : members) {
        Record& r = record(objective);
        r.failed = !r.optimal && !r.unbounded;
      }
    }
  }

  Step solve_value(Place& place, std::int64_t objective) {
    const Basis& start = vertices_[static_cast<std::size_t>(record(objective).vertex)].basis;
    const LpAnswer answer = solver(place).maximise(examiner_.signed_objective(objective), start);
    Step step;
    if (answer.status == LpStatus::kOptimal) {
      step = visit(answer.basis);
      for (Finding& finding : step.findings) {
        // The solver calls this optimal: the value stands, and its residual tells how far it can be trusted.
        if (finding.objective == objective) finding.optimal = true;
      }
    }
    step.objective = objective;
    step.status = answer.status;
    step.work.add(answer);
    return step;
  }

  /// Sec. II G: minima from the first extremal point, maxima from the minima, each walked to by itself.
  void walk_to_values(const Basis& start) {
    for (const bool maxima : {false, true}) {
      std::vector<std::int64_t> members;
      const auto flush = [&] {
        if (members.empty()) return;
        std::vector<Step> steps(members.size());
        team_.run(static_cast<std::int64_t>(members.size()), [&](int, std::int64_t i) {
          const auto at = static_cast<std::size_t>(i);
          steps[at] = walk_to_value(members[at], start);
        });
        merge(std::move(steps));
        report();
        for (const std::int64_t objective : members) record(objective).failed = !record(objective).optimal;
        members.clear();
      };
      for (std::int64_t objective = maxima ? 1 : 0; objective < examiner_.objectives(); objective += 2) {
        if (!record(objective).wanted) continue;
        members.push_back(objective);
        if (members.size() == kWalks) flush();
      }
      flush();
    }
  }

  Step walk_to_value(std::int64_t objective, const Basis& start) const {
    const Record& minimum = record(objective - objective % 2);
    const bool has_minimum = objective % 2 == 1 && minimum.optimal;
    const Walk walk =
        walker_.walk(examiner_.signed_objective(objective),
                     has_minimum ? vertices_[static_cast<std::size_t>(minimum.vertex)].basis : start);
    Step step;
    if (walk.end != WalkEnd::kDirectionsLost && walk.end != WalkEnd::kEdgeWithoutEnd &&
        walk.end != WalkEnd::kStepLimit) {
      step.status = LpStatus::kOptimal;
      step.visited = examiner_.visit(walk.basis);
      step.findings = examiner_.judge(std::array{objective}, *step.visited);
      step.findings.front().optimal = true;  // as the method says; the residual tells whether it is right
    }
    step.objective = objective;
    step.work.solves = 1;
    step.work.pivots = walk.steps;
    step.paper.walks[static_cast<std::size_t>(walk.end)] = 1;
    step.paper.points = walk.steps + 1;
    step.paper.unexpected = walk.unexpected;
    step.paper.neighbours = walk.neighbours;
    return step;
  }

  void find_states() {
    const auto is_open = [this](const Record& r) {
      // Without a proof of optimality the optimal face is not known.
      return r.wanted && r.optimal && !r.canonical && !r.stateless &&
             r.dual_residual <= tolerance::kReducedCost;
    };
    first_open_ = 0;
    for (;;) {
      const std::vector<std::int64_t> members = choose_members(is_open);
      if (members.empty()) break;
      round(members, [this](Place& place, std::int64_t objective) { return solve_state(place, objective); });
      for (const std::int64_t objective : members) record(objective).stateless = !record(objective).canonical;
    }
  }

  /// The lightest state of the optimal face of a settled objective.
  Step solve_state(Place& place, std::int64_t objective) {
    const Record& known = record(objective);
    std::vector<int> held = known.held;
    Basis basis = vertices_[static_cast<std::size_t>(known.vertex)].basis;
    Step step;
    Work work;
    bool found = true;
    for (const Objective* functional : {&examiner_.lightness(), &examiner_.generic()}) {
      const LpAnswer answer = solver(place).maximise(*functional, basis, held);
      work.add(answer);
      found = answer.status == LpStatus::kOptimal;
      if (!found) break;
      basis = answer.basis;
      const Vertex vertex = compute_vertex(set_, basis);
      const Eigen::VectorXd costs = vertex.multipliers(functional->along_z);
      std::vector<int> face = held;
      bool more = false;
      for (Eigen::Index k = 0; k < costs.size(); ++k) {
        const int inequality = basis[static_cast<std::size_t>(k)];
        if (std::binary_search(held.begin(), held.end(), inequality)) continue;
        if (costs[k] > tolerance::kReducedCost) {
          face.push_back(inequality);
        } else {
          more = true;
        }
      }
      std::sort(face.begin(), face.end());
      held = std::move(face);
      if (!more) break;
    }
    if (found) {
      step = visit(basis);
      step.settles_state = true;
      step.unique =
          !examiner_.has_free_edge(*step.visited, known.held) && is_point(place, basis, known.held, work);
    }
    step.objective = objective;
    step.work = work;
    return step;
  }

  /// True if the face {x_k = 0, k ∈ held} is the given vertex alone: the generic functional is constant on
  /// it. Asked only at degenerate vertices.
  bool is_point(Place& place, const Basis& basis, const std::vector<int>& held, Work& work) {
    Objective opposite = examiner_.generic();
    opposite.along_z *= -1;
    for (auto& [index, coefficient] : opposite.on_edges) coefficient *= -1;
    std::vector<double> values;
    for (const Objective* functional :
         std::initializer_list<const Objective*>{&examiner_.generic(), &opposite}) {
      const LpAnswer answer = solver(place).maximise(*functional, basis, held);
      work.add(answer);
      if (answer.status != LpStatus::kOptimal) return false;
      values.push_back(examiner_.generic().along_z.dot(compute_vertex(set_, answer.basis).z));
    }
    return std::abs(values[0] - values[1]) <= tolerance::kSliding * std::max(1.0, std::abs(values[0]));
  }

  SearchResult result() {
    SearchResult result;
    result.solves = work_.solves;
    result.continued = work_.continued;
    result.pivots = work_.pivots;
    result.paper = paper_;
    std::vector<int> number(vertices_.size(), -1);
    for (std::int64_t objective = 0; objective < static_cast<std::int64_t>(records_.size()); ++objective) {
      const Record& r = record(objective);
      Extremum extremum;
      if (r.wanted && r.optimal) {
        int& id = number[static_cast<std::size_t>(r.vertex)];
        if (id < 0) {
          id = static_cast<int>(result.vertices.size());
          result.vertices.push_back(vertices_[static_cast<std::size_t>(r.vertex)]);
        }
        extremum.status = Extremum::Status::kOptimal;
        extremum.vertex = id;
        extremum.value = examiner_.value_of(objective / 2, result.vertices[static_cast<std::size_t>(id)].x);
        extremum.dual_residual = r.dual_residual;
        extremum.proof = r.proof;
        extremum.unique = r.unique;
      } else if (r.wanted) {
        extremum.status = r.unbounded ? Extremum::Status::kUnbounded : Extremum::Status::kFailed;
      }
      (objective % 2 == 0 ? result.minimum : result.maximum).push_back(extremum);
    }
    return result;
  }

  const FeasibleSet& set_;
  const SearchOptions& options_;
  Examiner examiner_;
  NeighbourSearch walker_;
  std::vector<Record> records_;
  std::vector<Vertex> vertices_;  ///< without their factors
  Work work_;
  PaperWork paper_;
  std::array<Place, kRound> places_;
  std::int64_t first_open_ = 0;  ///< No objective before is open.
  WorkerTeam team_;              // last: its threads use the members above
};

}  // namespace

SearchResult search_extrema(const FeasibleSet& set, const std::vector<Component>& components,
                            const Eigen::VectorXd& weight, const Basis& start, const SearchOptions& options) {
  return Search(set, components, weight, options).run(start);
}

}  // namespace indet
