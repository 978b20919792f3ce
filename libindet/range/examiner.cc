#include "libindet/range/examiner.h"

#include <algorithm>
#include <iterator>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

bool is_lightest_along(const Visit& visit, Eigen::Index k) {
  const double first = visit.secondary(0, k);
  if (first > tolerance::kReducedCost) return true;
  return first >= -tolerance::kReducedCost && visit.secondary(1, k) >= -tolerance::kReducedCost;
}

}  // namespace

Examiner::Examiner(const FeasibleSet& set, const std::vector<Component>& components,
                   const Eigen::VectorXd& weight, bool canonical_states)
    : set_(set), components_(components), weight_(weight), canonical_states_(canonical_states) {
  rows_.resize(static_cast<Eigen::Index>(components.size()), set.dim());
  for (std::size_t c = 0; c < components.size(); ++c) {
    objectives_.push_back(make_objective(set, components[c].on_edges));
    rows_.row(static_cast<Eigen::Index>(c)) = objectives_.back().along_z.transpose();
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

Objective Examiner::signed_objective(std::int64_t number) const {
  Objective objective = objectives_[static_cast<std::size_t>(number / 2)];
  const double sign = sign_of(number);
  objective.along_z *= sign;
  for (auto& [index, coefficient] : objective.on_edges) coefficient *= sign;
  return objective;
}

double Examiner::value_of(std::int64_t component, const Eigen::VectorXd& x) const {
  double value = 0;
  for (const auto& [index, coefficient] : components_[static_cast<std::size_t>(component)].on_edges)
    value += coefficient * x[index];
  return value;
}

Visit Examiner::visit(const Basis& basis) const {
  Visit visit;
  visit.vertex = compute_vertex(set_, basis);
  visit.values.resize(rows_.rows());
  for (Eigen::Index c = 0; c < rows_.rows(); ++c) visit.values[c] = value_of(c, visit.vertex.x);
  visit.weight = weight_.dot(visit.vertex.x);
  if (canonical_states_) {
    visit.secondary.resize(2, set_.dim());
    visit.secondary.row(0) = visit.vertex.multipliers(lightness_.along_z).transpose();
    visit.secondary.row(1) = visit.vertex.multipliers(generic_.along_z).transpose();
  }
  visit.has_length.resize(static_cast<std::size_t>(set_.dim()));
  return visit;
}

std::vector<Finding> Examiner::judge(std::span<const std::int64_t> objectives, Visit& visit) const {
  std::vector<int> rows;
  for (const std::int64_t objective : objectives) {
    const int row = static_cast<int>(objective / 2);
    if (rows.empty() || rows.back() != row) rows.push_back(row);
  }
  if (rows.empty()) return {};
  const Eigen::MatrixXd chosen = rows_(rows, Eigen::all).transpose();
  const Eigen::MatrixXd change = visit.vertex.active.transpose().solve(chosen);  // d × chosen: g S_N⁻¹
  std::vector<Finding> findings;
  std::size_t row = 0;
  for (const std::int64_t objective : objectives) {
    while (rows[row] != objective / 2) ++row;
    findings.push_back(
        judge_one(objective, visit, change.col(static_cast<Eigen::Index>(row)) * -sign_of(objective)));
  }
  return findings;
}

/// Reads the reduced costs λ (positive: leaving inequality k loses).
Finding Examiner::judge_one(std::int64_t objective, Visit& visit, const Eigen::VectorXd& costs) const {
  Finding finding;
  finding.objective = objective;
  finding.value = sign_of(objective) * visit.values[objective / 2];
  const double lowest = costs.size() > 0 ? costs.minCoeff() : 0;
  finding.dual_residual = std::max(0.0, -lowest);
  finding.optimal = lowest >= -tolerance::kReducedCost;
  if (!finding.optimal) return finding;
  finding.canonical = true;
  finding.unique = true;
  for (Eigen::Index k = 0; k < costs.size(); ++k) {
    if (costs[k] > tolerance::kReducedCost) {
      finding.held.push_back(visit.vertex.basis[static_cast<std::size_t>(k)]);
      continue;
    }
    finding.unique = false;
    if (!canonical_states_) continue;
    finding.canonical = finding.canonical && is_lightest_along(visit, k);
  }
  // Whether a degenerate vertex is alone on its face is asked later; here only the clear case counts.
  if (canonical_states_ && finding.canonical && !finding.unique) {
    finding.canonical = has_free_edge(visit, finding.held);
  }
  return finding;
}

bool Examiner::has_free_edge(Visit& visit, const std::vector<int>& held) const {
  for (int k = 0; k < set_.dim(); ++k) {
    const int inequality = visit.vertex.basis[static_cast<std::size_t>(k)];
    if (std::binary_search(held.begin(), held.end(), inequality)) continue;
    if (edge_has_length(visit, k) && keeps_to(visit, k, held)) return true;
  }
  return false;
}

/// True if edge k leaves those of the face's inequalities at zero that a degenerate vertex has not in its
/// basis.
bool Examiner::keeps_to(const Visit& visit, int k, const std::vector<int>& held) const {
  const Basis& basis = visit.vertex.basis;
  std::vector<int> others;
  std::set_difference(held.begin(), held.end(), basis.begin(), basis.end(), std::back_inserter(others));
  if (others.empty()) return true;
  const Eigen::VectorXd rates = set_.slope(others, Eigen::all) * visit.vertex.edge(k);
  return rates.lpNorm<Eigen::Infinity>() <= tolerance::kReducedCost;
}

bool Examiner::edge_has_length(Visit& visit, int k) const {
  auto& known = visit.has_length[static_cast<std::size_t>(k)];
  if (!known) known = edge_length(set_, visit.vertex, k) > tolerance::kSliding;
  return *known;
}

}  // namespace indet
