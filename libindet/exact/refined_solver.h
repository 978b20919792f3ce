#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "libindet/base/sparse_lu.h"
#include "libindet/exact/block_form.h"
#include "libindet/exact/integer_column.h"

namespace indet::exact {

/// Numbers that are known to lie within radius · 2^exponent of centre[i] · 2^exponent; those that `vanish`
/// are 0.
struct EnclosedVector {
  std::vector<mpz_class> centre;
  std::vector<bool> vanishes;
  mpz_class radius = 0;
  long exponent = 0;
};

/// Encloses the solutions of B x = b and Bᵀ y = c for a square sparse B, with all rounding accounted for.
/// With a factorisation of B in double precision, iterative refinement
///
///   x := x + (LU)⁻¹ (b − B x)
///
/// in fixed point, whose residuals are computed without rounding, gains some 40 bits a step. For what is
/// left, ‖B⁻¹ r‖∞ ≤ ‖B⁻¹‖∞ ‖r‖∞, and with the approximate inverse R of double precision and G = 1 − R B
///
///   ‖B⁻¹‖ ≤ ‖R‖ / (1 − ‖G‖)   if ‖G‖ < 1, which proves B to be regular
///
/// (Rump, Acta Numerica 19, 287 (2010)); of the transposed system in the other norm. R is looked at a few
/// rows at a time, and never stored. Unknowns that the right-hand side does not reach in the block triangular
/// form are exactly 0.
class RefinedSolver {
 public:
  /// True entries of B are value · 2^−shift; the columns must outlive the solver. Nothing if B is not proven
  /// to be regular. Precondition: at least one column.
  static std::unique_ptr<RefinedSolver> create(std::vector<const IntegerColumn*> columns);

  /// Radii are about 2^−kBits ‖B⁻¹‖ of the largest number on the right. Nothing if numbers are too large for
  /// doubles.
  static constexpr long kBits = 160;
  const BlockForm& blocks() const { return blocks_; }
  /// A bound of ‖B⁻ᵀ‖∞.
  double transposed_inverse_norm() const { return transposed_norm_; }
  std::optional<EnclosedVector> solve(const std::vector<mpz_class>& b) const { return refine(b, false); }
  std::optional<EnclosedVector> solve_transposed(const std::vector<mpz_class>& c) const {
    return refine(c, true);
  }

 private:
  explicit RefinedSolver(std::vector<const IntegerColumn*> columns);
  bool bound_inverse();
  std::vector<mpz_class> residual(const std::vector<mpz_class>& right, long left_shift,
                                  const std::vector<mpz_class>& x, bool transposed) const;
  std::optional<EnclosedVector> refine(const std::vector<mpz_class>& right, bool transposed) const;

  std::vector<const IntegerColumn*> columns_;
  long most_shift_ = 0;  ///< of the columns
  std::vector<int> first_, rows_;
  std::vector<double> entries_;
  SparseLu lu_;
  mutable std::mutex lu_in_use_;
  BlockForm blocks_{0};
  double norm_ = 0, transposed_norm_ = 0;  ///< bounds of ‖B⁻¹‖∞ and ‖B⁻ᵀ‖∞
};

}  // namespace indet::exact
