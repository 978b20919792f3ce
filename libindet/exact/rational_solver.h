#pragma once

#include <memory>
#include <vector>

#include "libindet/exact/modular_lu.h"

namespace indet::exact {

/// A rational vector over one denominator: entry i is numerator[i] / denominator, denominator > 0.
struct RationalVector {
  std::vector<mpz_class> numerator;
  mpz_class denominator = 1;

  mpq_class operator[](std::size_t i) const {
    mpq_class value(numerator[i], denominator);
    value.canonicalize();
    return value;
  }
};

/// Solves B x = b and Bᵀ y = c exactly for a square sparse integer matrix, by p-adic lifting (Dixon, Numer.
/// Math. 40, 137 (1982)): with C = B⁻¹ mod p, known by a sparse LU factorisation,
///
///   r_0 = b,   x_i = C r_i mod p,   r_{i+1} = (r_i − B x_i) / p,   x = Σ x_i p^i  (mod p^k)
///
/// and x is read off by rational reconstruction once p^k exceeds twice the product of numerator and
/// denominator. The solution is multiplied back before it is returned, so it is right whatever happened
/// before.
class RationalSolver {
 public:
  /// `columns` are those of B (their shifts are ignored), on rows 0 … n − 1, n = columns.size(). The columns
  /// must outlive the solver. Returns nothing if B is singular modulo several primes near 2^62, so that it is
  /// singular for all practical purposes; no claim is made then.
  static std::unique_ptr<RationalSolver> create(std::vector<const IntegerColumn*> columns);

  RationalVector solve(const std::vector<mpz_class>& b) const;
  RationalVector solve_transposed(const std::vector<mpz_class>& c) const;

 private:
  RationalSolver(std::vector<const IntegerColumn*> columns, std::uint64_t prime);
  /// right -= B x, or Bᵀ x
  void subtract_product(const std::vector<std::uint64_t>& x, bool transposed,
                        std::vector<mpz_class>& right) const;
  bool holds(const RationalVector& x, bool transposed, const std::vector<mpz_class>& right) const;
  RationalVector lift(const std::vector<mpz_class>& right, bool transposed) const;

  std::vector<const IntegerColumn*> columns_;
  PrimeField field_;
  ModularLu lu_;
};

}  // namespace indet::exact
