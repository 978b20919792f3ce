#include "libindet/range/unlimited_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include "libindet/base/rounding_bounds.h"
#include "libindet/base/sparse_lu.h"
#include "libindet/polytope/recession_cone.h"
#include "libindet/polytope/unbounded_polytope.h"
#include "libindet/range/pivot_preference.h"

namespace indet {
namespace {

/// Of A_JC, whose inverse is looked at as a whole; some seconds.
constexpr std::size_t kMostColumns = 4000;

/// The row of the problem that stands for each row of the exact one, −1 if none does. Rows of the same body
/// differ by a factor, and those of bounds are combined with others (DoubledEquations).
std::vector<int> rows_of_exact(const ForcePolytope& polytope) {
  std::vector<int> result(static_cast<std::size_t>(polytope.exact->rows()), -1);
  for (int i = 0; i < polytope.problem.equations(); ++i) {
    const EquilibriumRow& row = polytope.problem.rows[static_cast<std::size_t>(i)];
    const int number = row.bound >= 0 ? polytope.exact->row_of_bound(row.bound)
                                      : polytope.exact->row(row.body, row.component);
    if (number >= 0) result[static_cast<std::size_t>(number)] = i;
  }
  return result;
}

using exact::Terms;

}  // namespace

UnlimitedEdges::UnlimitedEdges(const ForcePolytope& polytope, const DoubledEquations& equations)
    : polytope_(polytope),
      equations_(equations),
      contains_(static_cast<std::size_t>(equations.columns()), false),
      reach_(Eigen::VectorXd::Zero(equations.columns())) {
  if (polytope.status != PolytopeStatus::kUnbounded) return;
  find_edges();
  for (const int k : edges_) contains_[static_cast<std::size_t>(k)] = true;
  if (edges_.empty() || !find_columns() || !bound_inverse()) return;
  std::vector<bool> is_in_J(static_cast<std::size_t>(equations.rows()), false);
  for (const int row : rows_) is_in_J[static_cast<std::size_t>(row)] = true;
  for (int k = 0; k < equations.columns(); ++k) {
    for (const DoubledEquations::Entry& entry : equations.column(k)) {
      if (is_in_J[static_cast<std::size_t>(entry.row)]) reach_[k] += kWiden * std::abs(entry.value.high);
    }
  }
  for (const int row : rows_) load_reach_ += kWiden * std::abs(equations.load(row).high);
}

void UnlimitedEdges::find_edges() {
  if (polytope_.unbounded) {
    edges_ = polytope_.unbounded->unlimited;
    return;
  }
  for (const PolytopeBlock& block : polytope_.blocks) {
    if (!block.recession) continue;
    for (const int k : block.recession->loaded) edges_.push_back(block.edges[static_cast<std::size_t>(k)]);
  }
  std::sort(edges_.begin(), edges_.end());
}

bool UnlimitedEdges::find_columns() {
  const exact::ContactProblem& exact = *polytope_.exact;
  std::vector<bool> open(static_cast<std::size_t>(exact.edges()), false);
  std::map<int, int> edge_of_exact;
  for (const int k : edges_) {
    const int number = polytope_.problem.half_plane(polytope_.problem.edge(k));
    open[static_cast<std::size_t>(number)] = true;
    edge_of_exact[number] = k;
  }
  const exact::ContactProblem cone = exact.restricted_to(open);
  std::vector<int> numbers;
  for (const auto& [number, k] : edge_of_exact) numbers.push_back(number);
  basis_ = cone.choose_basis(pivot_preference(exact, numbers));
  if (basis_.empty() || std::ssize(basis_) != cone.rank() || basis_.size() > kMostColumns) return false;
  const std::vector<int> row_of_exact = rows_of_exact(polytope_);
  for (const int row : cone.independent_rows()) rows_.push_back(row_of_exact[static_cast<std::size_t>(row)]);
  if (std::find(rows_.begin(), rows_.end(), -1) != rows_.end()) return false;

  std::vector<Terms> other_rows(static_cast<std::size_t>(cone.rows()));  // of the columns C
  for (std::size_t c = 0; c < basis_.size(); ++c) {
    columns_.push_back(edge_of_exact.at(basis_[c]));
    const exact::IntegerColumn& column = cone.edge(basis_[c]);
    square_.push_back(cone.on_independent_rows(column));
    for (std::size_t e = 0; e < column.row.size(); ++e) {
      const auto row = static_cast<std::size_t>(column.row[e]);
      if (cone.row_number()[row] < 0)
        other_rows[row].emplace_back(static_cast<int>(c), exact::scaled(column.value[e], -column.shift));
    }
  }
  std::vector<const exact::IntegerColumn*> pointers;
  for (const exact::IntegerColumn& column : square_) pointers.push_back(&column);
  solver_ = exact::BasisSolver::create(std::move(pointers));
  if (!solver_) return false;
  for (const auto& [number, k] : edge_of_exact) {
    if (std::binary_search(basis_.begin(), basis_.end(), number)) continue;
    const exact::IntegerColumn& column = cone.edge(number);
    std::vector<mpz_class> right(basis_.size());
    std::map<std::size_t, mpq_class> on_others;
    for (std::size_t e = 0; e < column.row.size(); ++e) {
      const auto row = static_cast<std::size_t>(column.row[e]);
      const int place = cone.row_number()[row];
      if (place >= 0) right[static_cast<std::size_t>(place)] = column.value[e];
      if (place < 0) on_others[row] = column.value[e];
    }
    combinations_.push_back(
        {number, exact::scaled(mpq_class(1), column.shift), solver_->solve(std::move(right))});
    // It holds on the independent rows; on the others it must, too.
    for (std::size_t row = 0; row < other_rows.size(); ++row) {
      if (other_rows[row].empty() && !on_others.contains(row)) continue;
      const mpq_class there = on_others.contains(row) ? on_others.at(row) : mpq_class(0);
      if (combinations_.back().beta.compare(exact::integer_terms(other_rows[row]), there) != 0) return false;
    }
  }
  return true;
}

/// With P an approximate inverse of S = A_JCᵀ and G = S P − 1: ‖S⁻¹‖∞ ≤ ‖P‖∞ / (1 − ‖G‖∞).
bool UnlimitedEdges::bound_inverse() {
  const std::size_t n = columns_.size();
  std::vector<int> number(static_cast<std::size_t>(equations_.rows()), -1);
  for (std::size_t j = 0; j < n; ++j) number[static_cast<std::size_t>(rows_[j])] = static_cast<int>(j);
  std::vector<int> first{0}, rows;
  std::vector<double> entries;
  for (const int k : columns_) {
    for (const DoubledEquations::Entry& entry : equations_.column(k)) {
      const int row = number[static_cast<std::size_t>(entry.row)];
      if (row < 0) continue;
      rows.push_back(row);
      entries.push_back(entry.value.high);
    }
    first.push_back(static_cast<int>(rows.size()));
  }
  const std::vector<int> first_of = first, row_of = rows;
  const std::vector<double> entry_of = entries;
  SparseLu lu;
  if (lu.factor(first, rows, entries)) return false;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n)), defect = inverse;
  std::vector<double> column(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::fill(column.begin(), column.end(), 0.0);
    column[j] = 1;
    lu.solve_transposed(column);
    for (std::size_t i = 0; i < n; ++i) inverse[static_cast<Eigen::Index>(i)] += std::abs(column[i]);
    for (std::size_t c = 0; c < n; ++c) {
      double dot = c == j ? -1 : 0;
      double size = std::abs(dot);
      for (int at = first_of[c]; at < first_of[c + 1]; ++at) {
        const double product = column[static_cast<std::size_t>(row_of[static_cast<std::size_t>(at)])] *
                               entry_of[static_cast<std::size_t>(at)];
        dot += product;
        size += std::abs(product);
      }
      defect[static_cast<Eigen::Index>(c)] +=
          std::abs(dot) + (first_of[c + 1] - first_of[c] + 4) * kRoundoff * size + kTiny;
    }
  }
  const double widen = kWiden + 8 * static_cast<double>(n) * kRoundoff;
  const double gamma = widen * defect.maxCoeff();
  if (!(gamma < 0.5)) return false;
  inverse_norm_ = widen * inverse.maxCoeff() / (1 - gamma);
  return true;
}

bool UnlimitedEdges::is_level(std::span<const std::pair<int, double>> on_forces) const {
  std::map<int, mpq_class> coefficients;
  for (const auto& [component, coefficient] : on_forces) coefficients[component] += mpq_class(coefficient);
  const auto coefficient_of = [&](int component) {
    const auto found = coefficients.find(component);
    return found == coefficients.end() ? mpq_class(0) : found->second;
  };
  const auto on_edge = [&](int edge) -> mpq_class {
    if (polytope_.exact->is_slack(edge)) return 0;
    const int contact = edge / 2;
    const mpq_class along = coefficient_of(2 * contact + 1) * polytope_.exact->mu(contact);
    return coefficient_of(2 * contact) + (edge % 2 == 0 ? along : mpq_class(-along));
  };
  Terms terms;
  for (std::size_t c = 0; c < basis_.size(); ++c) {
    const mpq_class coefficient = on_edge(basis_[c]);
    if (coefficient != 0) terms.emplace_back(static_cast<int>(c), coefficient);
  }
  const exact::IntegerColumn on_columns = exact::integer_terms(terms);
  return std::all_of(combinations_.begin(), combinations_.end(), [&](const Combination& combination) {
    const mpq_class expected = on_edge(combination.edge) * combination.scale;
    return terms.empty() ? expected == 0 : combination.beta.compare(on_columns, expected) == 0;
  });
}

double UnlimitedEdges::shift(const Bounded& residual) const {
  if (edges_.empty()) return 0;
  double largest = 0;
  for (const int k : columns_)
    largest = std::fmax(largest, std::abs(residual.value[k]) + kWiden * residual.error[k]);
  const double shift = kWiden * inverse_norm_ * largest;
  return std::isnan(shift) ? kInfinity : shift;
}

}  // namespace indet
