#include "libindet/exact/edge_span.h"

#include <utility>

namespace indet::exact {

EdgeSpan::EdgeSpan(const ContactProblem& problem, std::span<const int> edges,
                   std::span<const double> preference) {
  std::vector<bool> open(static_cast<std::size_t>(problem.edges()), false);
  for (const int e : edges) open[static_cast<std::size_t>(e)] = true;
  const ContactProblem alone = problem.restricted_to(open);
  row_number_ = alone.row_number();
  basis_ = alone.choose_basis(preference);
  if (basis_.empty() || std::ssize(basis_) != alone.rank()) return;
  other_rows_.resize(row_number_.size());
  for (std::size_t c = 0; c < basis_.size(); ++c) {
    const IntegerColumn& column = problem.edge(basis_[c]);
    square_.push_back(alone.on_independent_rows(column));
    for (std::size_t k = 0; k < column.row.size(); ++k) {
      const auto row = static_cast<std::size_t>(column.row[k]);
      if (row_number_[row] < 0)
        other_rows_[row].emplace_back(static_cast<int>(c), scaled(column.value[k], -column.shift));
    }
  }
  std::vector<const IntegerColumn*> pointers;
  for (const IntegerColumn& column : square_) pointers.push_back(&column);
  solver_ = BasisSolver::create(std::move(pointers));
}

EdgeSpan::Combination EdgeSpan::combination(const std::vector<mpq_class>& right) const {
  mpz_class scale = 1;
  for (const mpq_class& value : right) scale = lcm(scale, value.get_den());
  std::vector<mpz_class> on_rows(basis_.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (row_number_[i] >= 0)
      on_rows[static_cast<std::size_t>(row_number_[i])] = mpq_class(right[i] * scale).get_num();
  }
  return {solver_->solve(std::move(on_rows)), scale};
}

bool EdgeSpan::holds(const Combination& combination, const std::vector<mpq_class>& right) const {
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (row_number_[i] >= 0) continue;
    const Terms& row = other_rows_[i];
    // Without terms no enclosure is needed.
    if (row.empty() ? right[i] != 0
                    : combination.x.compare(integer_terms(row), right[i] * combination.scale) != 0)
      return false;
  }
  return true;
}

}  // namespace indet::exact
