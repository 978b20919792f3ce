#include "libindet/range/optimality_checker.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

bool is_lightest_along(const CheckedVertex& checked, Eigen::Index k) {
  const double first = checked.state_costs(0, k);
  if (first > tolerance::kReducedCost) return true;
  return first >= -tolerance::kReducedCost && checked.state_costs(1, k) >= -tolerance::kReducedCost;
}

}  // namespace

OptimalityChecker::OptimalityChecker(const SlopeView& view, const std::vector<Component>& components,
                                     const Eigen::VectorXd& weight, bool canonical_states)
    : view_(view), components_(components), weight_(weight), canonical_states_(canonical_states) {
  rows_.resize(static_cast<Eigen::Index>(components.size()), view.dim());
  for (std::size_t c = 0; c < components.size(); ++c) {
    objectives_.push_back(make_objective(view, components[c].on_edges));
    rows_.row(static_cast<Eigen::Index>(c)) = objectives_.back().along_z.transpose();
  }
  std::vector<std::pair<int, double>> light;
  std::vector<std::pair<int, double>> generic;
  Random random(1);  // fixed weights in [1, 2), so that no two states of a face tie
  for (int k = 0; k < view.inequalities(); ++k) {
    light.emplace_back(k, -weight[k]);
    generic.emplace_back(k, -random.uniform(1, 2));
  }
  lightness_ = make_objective(view, light);
  generic_ = make_objective(view, generic);
}

Objective OptimalityChecker::signed_objective(std::int64_t number) const {
  Objective objective = objectives_[static_cast<std::size_t>(number / 2)];
  const double sign = sign_of(number);
  objective.along_z *= sign;
  for (auto& [index, coefficient] : objective.on_edges) coefficient *= sign;
  return objective;
}

double OptimalityChecker::value_of(std::int64_t component, const Eigen::VectorXd& x) const {
  double value = 0;
  for (const auto& [index, coefficient] : components_[static_cast<std::size_t>(component)].on_edges)
    value += coefficient * x[index];
  return value;
}

CheckedVertex OptimalityChecker::evaluate(Vertex vertex) const {
  CheckedVertex checked;
  checked.vertex = std::move(vertex);
  checked.values.resize(rows_.rows());
  for (Eigen::Index c = 0; c < rows_.rows(); ++c) checked.values[c] = value_of(c, checked.vertex.x);
  checked.weight = weight_.dot(checked.vertex.x);
  if (canonical_states_) {
    checked.state_costs.resize(2, view_.dim());
    checked.state_costs.row(0) = checked.vertex.multipliers(lightness_).transpose();
    checked.state_costs.row(1) = checked.vertex.multipliers(generic_).transpose();
  }
  checked.has_length.resize(static_cast<std::size_t>(view_.dim()));
  return checked;
}

std::vector<ObjectiveVerdict> OptimalityChecker::judge(std::span<const std::int64_t> objectives,
                                                       CheckedVertex& checked) const {
  std::vector<int> rows;
  for (const std::int64_t objective : objectives) {
    const int row = static_cast<int>(objective / 2);
    if (rows.empty() || rows.back() != row) rows.push_back(row);
  }
  if (rows.empty()) return {};
  const Eigen::MatrixXd change = changes(rows, checked.vertex);
  std::vector<ObjectiveVerdict> verdicts;
  std::size_t row = 0;
  for (const std::int64_t objective : objectives) {
    while (rows[row] != objective / 2) ++row;
    verdicts.push_back(
        judge_one(objective, checked, change.col(static_cast<Eigen::Index>(row)) * -sign_of(objective)));
  }
  return verdicts;
}

/// g S_N⁻¹ of the objectives of the given components. [d × rows]
Eigen::MatrixXd OptimalityChecker::changes(const std::vector<int>& rows, const Vertex& vertex) const {
  if (!vertex.sparse) {
    const Eigen::MatrixXd chosen = rows_(rows, Eigen::all).transpose();
    return vertex.active.transpose().solve(chosen);
  }
  Eigen::MatrixXd result(view_.dim(), std::ssize(rows));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.col(static_cast<Eigen::Index>(i)) =
        -vertex.multipliers(objectives_[static_cast<std::size_t>(rows[i])]);
  }
  return result;
}

/// Reads the reduced costs λ (positive: leaving inequality k loses).
ObjectiveVerdict OptimalityChecker::judge_one(std::int64_t objective, CheckedVertex& checked,
                                              const Eigen::VectorXd& costs) const {
  ObjectiveVerdict verdict;
  verdict.objective = objective;
  verdict.value = sign_of(objective) * checked.values[objective / 2];
  const double lowest = costs.size() > 0 ? costs.minCoeff() : 0;
  verdict.dual_residual = std::max(0.0, -lowest);
  verdict.optimal = lowest >= -tolerance::kReducedCost;
  if (!verdict.optimal) return verdict;
  verdict.canonical = true;
  verdict.unique = true;
  for (Eigen::Index k = 0; k < costs.size(); ++k) {
    if (costs[k] > tolerance::kReducedCost) {
      verdict.held.push_back(checked.vertex.basis[static_cast<std::size_t>(k)]);
      continue;
    }
    verdict.unique = false;
    if (!canonical_states_) continue;
    verdict.canonical = verdict.canonical && is_lightest_along(checked, k);
  }
  // Whether a degenerate vertex is alone on its face is asked later; here only the clear case counts.
  if (canonical_states_ && verdict.canonical && !verdict.unique) {
    verdict.canonical = has_free_polytope_edge(checked, verdict.held);
  }
  return verdict;
}

bool OptimalityChecker::has_free_polytope_edge(CheckedVertex& checked, const std::vector<int>& held) const {
  for (int k = 0; k < view_.dim(); ++k) {
    const int inequality = checked.vertex.basis[static_cast<std::size_t>(k)];
    if (std::binary_search(held.begin(), held.end(), inequality)) continue;
    if (polytope_edge_has_length(checked, k) && keeps_to(checked, k, held)) return true;
  }
  return false;
}

/// True if the polytope's edge k leaves those of the face's inequalities at zero that a degenerate vertex has
/// not in its basis.
bool OptimalityChecker::keeps_to(const CheckedVertex& checked, int k, const std::vector<int>& held) const {
  const Basis& basis = checked.vertex.basis;
  std::vector<int> others;
  std::set_difference(held.begin(), held.end(), basis.begin(), basis.end(), std::back_inserter(others));
  if (others.empty()) return true;
  const Eigen::VectorXd rates = checked.vertex.edge_rates(view_, k)(others);
  return rates.lpNorm<Eigen::Infinity>() <= tolerance::kHeldRate;
}

bool OptimalityChecker::polytope_edge_has_length(CheckedVertex& checked, int k) const {
  auto& known = checked.has_length[static_cast<std::size_t>(k)];
  if (!known) known = polytope_edge_length(view_, checked.vertex, k) > tolerance::kPolytopeEdge;
  return *known;
}

}  // namespace indet
