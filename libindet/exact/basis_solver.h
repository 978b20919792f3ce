#pragma once

#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "libindet/exact/rational_solver.h"
#include "libindet/exact/refined_solver.h"

namespace indet::exact {

class BasisSolver;

/// (Σ value[i] x[row[i]]) · 2^−shift / divisor of a solution x.
struct LinearForm {
  IntegerColumn terms;
  mpz_class divisor = 1;  ///< positive
};

/// The solution x of B x = b or Bᵀ y = c: an enclosure, and rational numbers where that does not decide what
/// is asked, or there is none. So every answer is the exact one.
class Solution {
 public:
  /// −1, 0, 1 as Σ value[i] x[row[i]] · 2^−shift is less than a number, equal, or larger.
  int compare(const IntegerColumn& terms, const mpq_class& number) const;
  int sign(const IntegerColumn& terms) const { return compare(terms, 0); }

  mpq_class value(const LinearForm& form) const;
  /// A number that no comparison with a double tells from the value, nor the rounding to one: the value
  /// itself, or within about 2^−100 of it, relative to the solution.
  mpq_class stand_in(const LinearForm& form) const;
  /// The double nearest to the value.
  double nearest(const LinearForm& form) const;
  /// Bounds of Σ value[i] x[row[i]] · 2^−shift.
  struct Bounds {
    mpq_class lower, upper;
  };
  Bounds bounds(const IntegerColumn& terms) const;

  /// All of it, in rational numbers.
  const RationalVector& exact() const;
  /// Whether rational numbers were needed so far.
  bool is_rational() const;

 private:
  friend class BasisSolver;
  Solution(const BasisSolver& solver, std::vector<mpz_class> right, bool transposed);

  /// A sum and what it may be off by, in units of 2^(exponent − shift).
  struct Ball {
    mpz_class centre, radius;
  };
  Ball ball(const IntegerColumn& terms) const;

  /// x on some blocks, 0 elsewhere.
  const RationalVector& exact_on(const BlockForm::Blocks& blocks) const;

  struct Known {
    std::mutex in_use;
    std::map<BlockForm::Blocks, RationalVector> solutions;
  };
  const BasisSolver* solver_;
  std::vector<mpz_class> right_;
  bool transposed_;
  std::optional<EnclosedVector> enclosed_;
  BlockForm::Blocks reached_;
  std::unique_ptr<Known> known_ = std::make_unique<Known>();
};

/// Solves B x = b and Bᵀ y = c for a square sparse B whose true entries are value · 2^−shift.
class BasisSolver {
 public:
  /// Nothing if B is singular, or for all practical purposes (RationalSolver::create). The columns must
  /// outlive the solver, and the solver its solutions.
  static std::unique_ptr<BasisSolver> create(std::vector<const IntegerColumn*> columns);

  /// A bound of ‖B⁻ᵀ‖∞; infinite if double precision does not prove that B is regular.
  double transposed_inverse_norm() const {
    return refined_ ? refined_->transposed_inverse_norm() : std::numeric_limits<double>::infinity();
  }
  Solution solve(std::vector<mpz_class> b) const { return {*this, std::move(b), false}; }
  Solution solve_transposed(std::vector<mpz_class> c) const { return {*this, std::move(c), true}; }

 private:
  friend class Solution;
  explicit BasisSolver(std::vector<const IntegerColumn*> columns)
      : columns_(std::move(columns)), blocks_(columns_.size()) {}
  /// Some blocks of B, which other unknowns do not enter.
  struct Part {
    std::vector<std::size_t> rows, columns;
    std::vector<IntegerColumn> entries;
    std::unique_ptr<RationalSolver> solver;
  };
  std::unique_ptr<Part> part_of(const BlockForm::Blocks& blocks) const;
  /// x on these blocks, 0 elsewhere. Precondition: nothing else enters their equations.
  RationalVector solve_exactly(const std::vector<mpz_class>& right, bool transposed,
                               const BlockForm::Blocks& blocks) const;

  std::vector<const IntegerColumn*> columns_;
  std::unique_ptr<RefinedSolver> refined_;  ///< none if double precision does not prove that B is regular
  BlockForm blocks_;
  mutable std::mutex parts_in_use_;
  mutable std::map<BlockForm::Blocks, std::unique_ptr<Part>> parts_;
};

}  // namespace indet::exact
