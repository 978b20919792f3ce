#include "indet/range/extremal_search.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>

#include "indet/base/error.h"
#include "indet/base/random.h"
#include "indet/base/tolerances.h"
#include "indet/base/worker_team.h"

namespace indet {
namespace {

/// Objectives a round. More let more threads work at once, but start from older knowledge: at N = 95, rounds
/// of 2 cost 2 % more pivots than rounds of 1, rounds of 4 cost 12 % (docs/decisions/rounds.md).
constexpr std::int64_t kRound = 2;

bool ties(double a, double b) {
  return std::abs(a - b) <= tolerance::kTie * std::max({1.0, std::abs(a), std::abs(b)});
}

/// A vertex with everything that the search asks of it.
struct Visit {
  Vertex vertex;
  Eigen::VectorXd values;  ///< of all components
  double weight = 0;
  Eigen::MatrixXd secondary;  ///< 2 × d: reduced costs of minimising weight·x, and the generic functional
  std::vector<std::optional<bool>>
      has_length;  ///< d: whether an edge has positive length, where it was asked

  bool edge_has_length(const FeasibleSet& set, int k) {
    auto& known = has_length[static_cast<std::size_t>(k)];
    if (!known) known = edge_length(set, vertex, k) > tolerance::kSliding;
    return *known;
  }
};

/// What one visited vertex proves about one objective.
struct Finding {
  std::int64_t objective = 0;
  double value = 0;
  bool optimal = false;    ///< no wrong-signed reduced cost
  bool canonical = false;  ///< … and no better state on the optimal face
  bool unique = false;     ///< all reduced costs positive
  double dual_residual = 0;
  std::vector<int> held;  ///< inequalities with positive reduced cost: they define the optimal face
};

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
  double dual_residual = 0;
  std::vector<int> held;
};

class Search {
 public:
  Search(const FeasibleSet& set, const std::vector<Component>& components, const Eigen::VectorXd& weight,
         const SearchOptions& options)
      : set_(set),
        components_(components),
        weight_(weight),
        options_(options),
        records_(2 * components.size()),
        solvers_(static_cast<std::size_t>(std::max(1, options.threads))),
        team_(options.threads, [this](int worker) { solvers_[static_cast<std::size_t>(worker)].reset(); }) {
    rows_.resize(static_cast<Eigen::Index>(components.size()), set.dim());
    for (std::size_t c = 0; c < components.size(); ++c) {
      objectives_.push_back(make_objective(set, components[c].on_edges));
      rows_.row(static_cast<Eigen::Index>(c)) = objectives_.back().along_z.transpose();
      records_[2 * c].wanted = components[c].minimise;
      records_[2 * c + 1].wanted = components[c].maximise;
    }
    std::vector<std::pair<int, double>> light;
    std::vector<std::pair<int, double>> generic;
    Random random(1);  // fixed weights in [1, 2), so that no two states of a face tie
    for (int k = 0; k < set.inequalities(); ++k) {
      light.emplace_back(k, -weight[k]);
      generic.emplace_back(k, -random.uniform(1, 2));
    }
    lightness_ = make_objective(set, light);
    generic_ = make_objective(set, generic);
  }

  SearchResult run(const Basis& start) {
    merge({visit(start)});
    find_values();
    if (options_.canonical_states) find_states();
    return result();
  }

 private:
  /// What a task hands back to the calling thread.
  struct Step {
    std::int64_t objective = -1;
    LpStatus status = LpStatus::kFailed;
    std::int64_t solves = 0;
    std::int64_t pivots = 0;
    bool settles_state = false;  ///< the vertex is the canonical state of `objective`
    bool unique = false;
    std::optional<Visit> visited;
    std::vector<Finding> findings;
  };

  LpSolver& solver(int worker) {
    auto& solver = solvers_[static_cast<std::size_t>(worker)];
    if (!solver) solver = std::make_unique<LpSolver>(set_, options_.formulation, options_.lp);
    return *solver;
  }

  Record& record(std::int64_t objective) { return records_[static_cast<std::size_t>(objective)]; }
  const Record& record(std::int64_t objective) const { return records_[static_cast<std::size_t>(objective)]; }
  static double sign_of(std::int64_t objective) { return objective % 2 == 0 ? -1.0 : 1.0; }

  Objective signed_objective(std::int64_t number) const {
    Objective objective = objectives_[static_cast<std::size_t>(number / 2)];
    const double sign = sign_of(number);
    objective.along_z *= sign;
    for (auto& [index, coefficient] : objective.on_edges) coefficient *= sign;
    return objective;
  }

  Step visit(const Basis& basis) const {
    Step step;
    step.status = LpStatus::kOptimal;
    Visit visited;
    visited.vertex = compute_vertex(set_, basis);
    visited.values.resize(rows_.rows());
    for (std::size_t c = 0; c < components_.size(); ++c) {
      double value = 0;
      for (const auto& [index, coefficient] : components_[c].on_edges)
        value += coefficient * visited.vertex.x[index];
      visited.values[static_cast<Eigen::Index>(c)] = value;
    }
    visited.weight = weight_.dot(visited.vertex.x);
    if (options_.canonical_states) {
      visited.secondary.resize(2, set_.dim());
      visited.secondary.row(0) = visited.vertex.multipliers(lightness_.along_z).transpose();
      visited.secondary.row(1) = visited.vertex.multipliers(generic_.along_z).transpose();
    }
    visited.has_length.resize(static_cast<std::size_t>(set_.dim()));
    step.findings = examine(visited);
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

  std::vector<Finding> examine(Visit& visited) const {
    std::vector<std::int64_t> candidates;
    std::vector<int> rows;
    for (std::int64_t c = 0; c < rows_.rows(); ++c) {
      const double value = visited.values[c];
      bool needed = false;
      for (const std::int64_t objective : {2 * c, 2 * c + 1}) {
        if (is_candidate(objective, value, visited.weight)) {
          candidates.push_back(objective);
          needed = true;
        }
      }
      if (needed) rows.push_back(static_cast<int>(c));
    }
    if (rows.empty()) return {};
    const Eigen::MatrixXd chosen = rows_(rows, Eigen::all).transpose();
    const Eigen::MatrixXd change = visited.vertex.active.transpose().solve(chosen);  // d × chosen: g S_N⁻¹
    std::vector<Finding> findings;
    std::size_t row = 0;
    for (const std::int64_t objective : candidates) {
      while (rows[row] != objective / 2) ++row;
      findings.push_back(
          judge(objective, visited, change.col(static_cast<Eigen::Index>(row)) * -sign_of(objective)));
    }
    return findings;
  }

  /// Reads the reduced costs λ (positive: leaving inequality k loses).
  Finding judge(std::int64_t objective, Visit& visited, const Eigen::VectorXd& costs) const {
    Finding finding;
    finding.objective = objective;
    finding.value = sign_of(objective) * visited.values[objective / 2];
    const double lowest = costs.size() > 0 ? costs.minCoeff() : 0;
    finding.dual_residual = std::max(0.0, -lowest);
    finding.optimal = lowest >= -tolerance::kReducedCost;
    if (!finding.optimal) return finding;
    finding.canonical = true;
    finding.unique = true;
    for (Eigen::Index k = 0; k < costs.size(); ++k) {
      if (costs[k] > tolerance::kReducedCost) {
        finding.held.push_back(visited.vertex.basis[static_cast<std::size_t>(k)]);
        continue;
      }
      finding.unique = false;
      if (!options_.canonical_states) continue;
      finding.canonical = finding.canonical && is_lightest_along(visited, k);
    }
    // Whether a degenerate vertex is alone on its face is asked later; here only the clear case counts.
    if (options_.canonical_states && finding.canonical && !finding.unique) {
      finding.canonical = has_free_edge(visited, finding.held);
    }
    return finding;
  }

  static bool is_lightest_along(const Visit& visited, Eigen::Index k) {
    const double first = visited.secondary(0, k);
    if (first > tolerance::kReducedCost) return true;
    return first >= -tolerance::kReducedCost && visited.secondary(1, k) >= -tolerance::kReducedCost;
  }

  /// True if some edge of the optimal face has positive length, so that the face is more than a point.
  bool has_free_edge(Visit& visited, const std::vector<int>& held) const {
    for (int k = 0; k < set_.dim(); ++k) {
      const int inequality = visited.vertex.basis[static_cast<std::size_t>(k)];
      if (std::binary_search(held.begin(), held.end(), inequality)) continue;
      if (visited.edge_has_length(set_, k)) return true;
    }
    return false;
  }

  /// Takes the findings of a round into the records, in the order of the round.
  void merge(std::vector<Step> steps) {
    for (Step& step : steps) {
      solves_ += step.solves;
      pivots_ += step.pivots;
      if (step.status == LpStatus::kUnbounded) record(step.objective).unbounded = true;
      if (!step.visited) continue;
      const int id = static_cast<int>(vertices_.size());
      bool kept = false;
      for (Finding& finding : step.findings) kept = take(finding, step.visited->weight, id) || kept;
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
      }
    }
  }

  bool take(Finding& finding, double weight, int id) {
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
    if (!known.optimal) known.held = std::move(finding.held);
    known.optimal = true;
    known.dual_residual = finding.dual_residual;
    known.canonical = finding.canonical || !options_.canonical_states;
    known.unique = finding.unique;
    return true;
  }

  /// Runs `work` on the members of a round, in parallel, and merges what they found.
  template <class Work>
  void round(const std::vector<std::int64_t>& members, Work work) {
    std::vector<Step> steps(members.size());
    team_.run(static_cast<std::int64_t>(members.size()), [&](int worker, std::int64_t i) {
      steps[static_cast<std::size_t>(i)] = work(worker, members[static_cast<std::size_t>(i)]);
    });
    merge(std::move(steps));
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

  void find_values() {
    std::vector<std::int64_t> members;
    const auto flush = [&] {
      if (members.empty()) return;
      round(members, [this](int worker, std::int64_t objective) { return solve_value(worker, objective); });
      for (const std::int64_t objective : members) {
        Record& r = record(objective);
        r.failed = !r.optimal && !r.unbounded;
      }
      members.clear();
    };
    for (std::int64_t objective = 0; objective < static_cast<std::int64_t>(records_.size()); ++objective) {
      const Record& r = record(objective);
      if (!r.wanted || r.optimal || r.unbounded || r.failed) continue;
      members.push_back(objective);
      if (static_cast<std::int64_t>(members.size()) == kRound) flush();
    }
    flush();
  }

  Step solve_value(int worker, std::int64_t objective) {
    const Basis& start = vertices_[static_cast<std::size_t>(record(objective).vertex)].basis;
    const LpAnswer answer = solver(worker).maximise(signed_objective(objective), start);
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
    step.solves = 1;
    step.pivots = answer.pivots;
    return step;
  }

  void find_states() {
    std::vector<std::int64_t> members;
    const auto flush = [&] {
      if (members.empty()) return;
      round(members, [this](int worker, std::int64_t objective) { return solve_state(worker, objective); });
      members.clear();
    };
    for (std::int64_t objective = 0; objective < static_cast<std::int64_t>(records_.size()); ++objective) {
      const Record& r = record(objective);
      if (!r.wanted || !r.optimal || r.canonical) continue;
      members.push_back(objective);
      if (static_cast<std::int64_t>(members.size()) == kRound) flush();
    }
    flush();
  }

  /// The lightest state of the optimal face of a settled objective.
  Step solve_state(int worker, std::int64_t objective) {
    const Record& known = record(objective);
    std::vector<int> held = known.held;
    Basis basis = vertices_[static_cast<std::size_t>(known.vertex)].basis;
    Step step;
    std::int64_t solves = 0;
    std::int64_t pivots = 0;
    bool found = true;
    for (const Objective* functional : {&lightness_, &generic_}) {
      const LpAnswer answer = solver(worker).maximise(*functional, basis, held);
      ++solves;
      pivots += answer.pivots;
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
          !has_free_edge(*step.visited, known.held) && is_point(worker, basis, known.held, solves, pivots);
    }
    step.objective = objective;
    step.solves = solves;
    step.pivots = pivots;
    return step;
  }

  /// True if the face {x_k = 0, k ∈ held} is the given vertex alone: the generic functional is constant on
  /// it. Asked only at degenerate vertices.
  bool is_point(int worker, const Basis& basis, const std::vector<int>& held, std::int64_t& solves,
                std::int64_t& pivots) {
    Objective opposite = generic_;
    opposite.along_z *= -1;
    for (auto& [index, coefficient] : opposite.on_edges) coefficient *= -1;
    std::vector<double> values;
    for (const Objective* functional : std::initializer_list<const Objective*>{&generic_, &opposite}) {
      const LpAnswer answer = solver(worker).maximise(*functional, basis, held);
      ++solves;
      pivots += answer.pivots;
      if (answer.status != LpStatus::kOptimal) return false;
      values.push_back(generic_.along_z.dot(compute_vertex(set_, answer.basis).z));
    }
    return std::abs(values[0] - values[1]) <= tolerance::kSliding * std::max(1.0, std::abs(values[0]));
  }

  SearchResult result() {
    SearchResult result;
    result.solves = solves_;
    result.pivots = pivots_;
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
        extremum.value = 0;
        for (const auto& [index, coefficient] :
             components_[static_cast<std::size_t>(objective / 2)].on_edges) {
          extremum.value += coefficient * result.vertices[static_cast<std::size_t>(id)].x[index];
        }
        extremum.dual_residual = r.dual_residual;
        extremum.unique = r.unique;
      } else if (r.wanted) {
        extremum.status = r.unbounded ? Extremum::Status::kUnbounded : Extremum::Status::kFailed;
      }
      (objective % 2 == 0 ? result.minimum : result.maximum).push_back(extremum);
    }
    return result;
  }

  const FeasibleSet& set_;
  const std::vector<Component>& components_;
  const Eigen::VectorXd& weight_;
  const SearchOptions& options_;
  Eigen::MatrixXd rows_;  ///< components × d
  std::vector<Objective> objectives_;
  Objective lightness_;
  Objective generic_;
  std::vector<Record> records_;
  std::vector<Vertex> vertices_;  ///< without their factors
  std::int64_t solves_ = 0;
  std::int64_t pivots_ = 0;
  std::vector<std::unique_ptr<LpSolver>> solvers_;
  WorkerTeam team_;  // last: its threads use the members above
};

}  // namespace

SearchResult search_extrema(const FeasibleSet& set, const std::vector<Component>& components,
                            const Eigen::VectorXd& weight, const Basis& start, const SearchOptions& options) {
  return Search(set, components, weight, options).run(start);
}

}  // namespace indet
