#pragma once

#include <memory>
#include <span>
#include <vector>

#include "libindet/exact/basis_solver.h"
#include "libindet/exact/contact_problem.h"

namespace indet::exact {

/// The span of the columns of some edges, by a basis: as many of these columns as are independent, regular on
/// as many rows. What is a combination of the basis on these rows, and on the others too, is in the span.
class EdgeSpan {
 public:
  /// `edges`: ascending. `preference`: one number an edge of the problem; the greater, the sooner it is taken
  /// for the basis.
  EdgeSpan(const ContactProblem& problem, std::span<const int> edges, std::span<const double> preference);

  /// Without a basis nothing else is to be asked.
  bool has_basis() const { return solver_ != nullptr; }
  const std::vector<int>& basis() const { return basis_; }  ///< edges, ascending
  /// Of each row its number among those of the basis, −1 if it is another one.
  const std::vector<int>& row_number() const { return row_number_; }
  /// ‖B⁻ᵀ‖∞ of the basis on its rows at most; infinite if double precision does not tell.
  double transposed_inverse_norm() const { return solver_->transposed_inverse_norm(); }

  /// x with Σ_c x_c a_c = scale · right on the rows of the basis.
  struct Combination {
    Solution x;
    mpz_class scale;  ///< positive
  };
  /// `right`: one binary fraction a row.
  Combination combination(const std::vector<mpq_class>& right) const;
  /// Whether it holds on all rows.
  bool holds(const Combination& combination, const std::vector<mpq_class>& right) const;

 private:
  std::vector<int> basis_, row_number_;
  std::vector<IntegerColumn> square_;
  std::vector<Terms> other_rows_;  ///< of each row beside those of the basis what the basis has there
  std::unique_ptr<BasisSolver> solver_;
};

}  // namespace indet::exact
