#include "libindet/range/unlimited_edges.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "libindet/base/rounding_bounds.h"
#include "libindet/polytope/recession_cone.h"
#include "libindet/range/pivot_preference.h"

namespace indet {
namespace {

/// Up to which an inverse is looked at as a whole; some seconds.
constexpr std::size_t kMostUnlimitedEdges = 8000;

/// What strengths of the exact problem are divided by in that of the polytope.
double scale_of(const ForcePolytope& polytope, int k) {
  const Edge& edge = polytope.problem.edge(k);
  return edge.is_slack() ? 1 : edge.R;
}

}  // namespace

UnlimitedEdges::UnlimitedEdges(const ForcePolytope& polytope)
    : exact_(*polytope.exact),
      contains_(static_cast<std::size_t>(polytope.problem.unknowns()), false),
      reach_(Eigen::VectorXd::Zero(polytope.problem.unknowns())) {
  for (const PolytopeBlock& block : polytope.blocks) {
    if (!block.recession) continue;
    for (const int k : block.recession->loaded)
      contains_[static_cast<std::size_t>(block.edges[static_cast<std::size_t>(k)])] = true;
  }
  std::map<int, int> unknown_of;
  std::vector<int> edges;
  for (int k = 0; k < polytope.problem.unknowns(); ++k) {
    if (!contains(k)) continue;
    const int edge = polytope.problem.half_plane(polytope.problem.edge(k));
    unknown_of[edge] = k;
  }
  for (const auto& [edge, k] : unknown_of) edges.push_back(edge);
  if (edges.empty()) return;
  norm_ = kInfinity;
  if (edges.size() > kMostUnlimitedEdges) return;
  span_.emplace(exact_, edges, pivot_preference(exact_, edges));
  if (!span_->has_basis() || !find_combinations(edges)) return;
  norm_ = span_->transposed_inverse_norm();
  for (const int edge : span_->basis()) {
    const int k = unknown_of.at(edge);
    columns_.emplace_back(k, scale_of(polytope, k));
  }
  bound_reach(polytope);
}

/// Every other column of U has to be a combination of the basis.
bool UnlimitedEdges::find_combinations(const std::vector<int>& edges) {
  for (const int edge : edges) {
    if (std::binary_search(span_->basis().begin(), span_->basis().end(), edge)) continue;
    const exact::IntegerColumn& column = exact_.edge(edge);
    std::vector<mpq_class> right(static_cast<std::size_t>(exact_.rows()));
    for (std::size_t k = 0; k < column.row.size(); ++k)
      right[static_cast<std::size_t>(column.row[k])] = exact::scaled(column.value[k], -column.shift);
    combinations_.emplace_back(edge, span_->combination(right));
    if (!span_->holds(combinations_.back().second, right)) return false;
  }
  return true;
}

void UnlimitedEdges::bound_reach(const ForcePolytope& polytope) {
  for (int k = 0; k < polytope.problem.unknowns(); ++k) {
    const exact::IntegerColumn& column = exact_.edge(polytope.problem.half_plane(polytope.problem.edge(k)));
    for (std::size_t e = 0; e < column.row.size(); ++e) {
      if (span_->row_number()[static_cast<std::size_t>(column.row[e])] < 0) continue;
      const double entry = exact::scaled(column.value[e], -column.shift).get_d();
      reach_[k] += kWiden * scale_of(polytope, k) * std::abs(entry);
    }
  }
  const mpq_class unit =
      mpq_class(exact_.load_scale()) * mpq_class(polytope.problem.units.internal_in_scene());
  for (int row = 0; row < exact_.rows(); ++row) {
    if (span_->row_number()[static_cast<std::size_t>(row)] < 0) continue;
    const mpq_class load = mpq_class(exact_.load()[static_cast<std::size_t>(row)]) / unit;
    load_reach_ += kWiden * std::abs(load.get_d());
  }
}

bool UnlimitedEdges::is_level(std::span<const std::pair<int, double>> on_forces) const {
  std::map<int, mpq_class> coefficients;
  for (const auto& [component, coefficient] : on_forces) coefficients[component] += mpq_class(coefficient);
  const auto coefficient_of = [&](int component) {
    const auto found = coefficients.find(component);
    return found == coefficients.end() ? mpq_class(0) : found->second;
  };
  const auto on_edge = [&](int edge) -> mpq_class {
    if (exact_.is_slack(edge)) return 0;
    const int contact = edge / 2;
    const mpq_class along = coefficient_of(2 * contact + 1) * exact_.mu(contact);
    return coefficient_of(2 * contact) + (edge % 2 == 0 ? along : mpq_class(-along));
  };
  if (!span_) return true;
  exact::Terms terms;
  const std::vector<int>& basis = span_->basis();
  for (std::size_t c = 0; c < basis.size(); ++c) {
    const mpq_class coefficient = on_edge(basis[c]);
    if (coefficient != 0) terms.emplace_back(static_cast<int>(c), coefficient);
  }
  const exact::IntegerColumn on_basis = exact::integer_terms(terms);
  return std::all_of(combinations_.begin(), combinations_.end(), [&](const auto& entry) {
    const auto& [edge, combination] = entry;
    const mpq_class expected = on_edge(edge) * combination.scale;
    return terms.empty() ? expected == 0 : combination.x.compare(on_basis, expected) == 0;
  });
}

double UnlimitedEdges::shift(const Bounded& residual) const {
  double largest = 0;
  for (const auto& [k, scale] : columns_)
    largest = std::fmax(largest, (std::abs(residual.value[k]) + residual.error[k]) / scale);
  const double shift = norm_ == 0 ? 0 : kWiden * norm_ * largest;
  return std::isnan(shift) ? kInfinity : shift;
}

}  // namespace indet
