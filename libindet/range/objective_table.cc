#include "libindet/range/objective_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

bool ties(double a, double b) {
  return std::abs(a - b) <= tolerance::kTie * std::max({1.0, std::abs(a), std::abs(b)});
}

}  // namespace

ObjectiveTable::ObjectiveTable(const std::vector<Component>& components, bool canonical_states,
                               VertexSink sink)
    : canonical_states_(canonical_states), sink_(std::move(sink)), objectives_(2 * components.size()) {
  for (std::size_t c = 0; c < components.size(); ++c) {
    objectives_[2 * c].wanted = components[c].minimise;
    objectives_[2 * c + 1].wanted = components[c].maximise;
  }
}

std::vector<std::int64_t> ObjectiveTable::candidates(const CheckedVertex& checked) const {
  std::vector<std::int64_t> candidates;
  for (std::int64_t objective = 0; objective < count(); ++objective) {
    const double better = OptimalityChecker::sign_of(objective) * checked.values[objective / 2];
    if (is_candidate((*this)[objective], better, checked.weight)) candidates.push_back(objective);
  }
  return candidates;
}

bool ObjectiveTable::is_candidate(const ObjectiveProgress& known, double better, double weight) const {
  if (!known.wanted || known.unbounded || known.failed || known.canonical) return false;
  if (!known.optimal && better > known.best) return true;
  if (!ties(better, known.best)) return false;
  return !known.optimal || (canonical_states_ && weight <= known.weight * (1 + tolerance::kHeavier));
}

std::vector<int> ObjectiveTable::merge(std::vector<TaskResult> results) {
  std::vector<int> numbers(results.size(), -1);
  for (std::size_t i = 0; i < results.size(); ++i) {
    TaskResult& result = results[i];
    work_ += result.work;
    paper_work_ += result.paper;
    if (result.status == LpStatus::kUnbounded) (*this)[result.objective].unbounded = true;
    if (!result.found) continue;
    const int number = vertex_count();
    bool is_kept = false;
    for (ObjectiveVerdict& verdict : result.verdicts)
      is_kept = take(verdict, *result.found, number) || is_kept;
    if (result.settles_state) {
      ObjectiveProgress& own = (*this)[result.objective];
      own.vertex = number;
      own.weight = result.found->weight;
      own.canonical = true;
      own.unique = result.unique;
      is_kept = true;
    }
    if (is_kept) {
      vertices_.push_back(std::move(result.found->vertex));
      vertices_.back().drop_factors();
      if (sink_) {
        hand_over(vertices_.back(), number, result.verdicts);
        vertices_.back().x = vertices_.back().z = {};
      }
      numbers[i] = number;
    }
  }
  return numbers;
}

/// Returns true if the vertex, with this number, now stands for the objective.
bool ObjectiveTable::take(ObjectiveVerdict& verdict, const CheckedVertex& checked, int number) {
  ObjectiveProgress& known = (*this)[verdict.objective];
  if (known.canonical) return false;
  const bool tie = ties(verdict.value, known.best);
  const bool lighter = tie && checked.weight < known.weight;
  const bool proves = verdict.optimal && !known.optimal && (tie || verdict.value > known.best);
  const bool improves = known.optimal ? lighter : (lighter || (!tie && verdict.value > known.best));
  const bool completes = tie && verdict.canonical;
  if (!proves && !improves && !completes) return false;
  known.best = known.optimal ? known.best : verdict.value;
  known.weight = checked.weight;
  known.vertex = number;
  if (!verdict.optimal) return true;
  if (!known.optimal) known.settled_at = number;
  // What a solver merely claims to be optimal does not tell the optimal face.
  if (!known.optimal || known.dual_residual > tolerance::kReducedCost) {
    if (canonical_states_) known.held = std::move(verdict.held);
    known.proof = checked.vertex.basis;
  }
  known.optimal = true;
  known.dual_residual = verdict.dual_residual;
  known.canonical = verdict.canonical || !canonical_states_;
  known.unique = verdict.unique;
  return true;
}

void ObjectiveTable::hand_over(const Vertex& vertex, int number,
                               const std::vector<ObjectiveVerdict>& verdicts) const {
  std::vector<std::int64_t> settled;
  for (const ObjectiveVerdict& verdict : verdicts) {
    if ((*this)[verdict.objective].settled_at == number) settled.push_back(verdict.objective);
  }
  if (!settled.empty()) sink_(vertex, settled);
}

bool ObjectiveTable::is_settled(const ObjectiveProgress& known) const {
  return known.unbounded || known.failed || known.canonical || (known.optimal && !canonical_states_);
}

}  // namespace indet
