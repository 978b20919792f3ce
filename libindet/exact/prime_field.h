#pragma once

#include <gmpxx.h>

#include <cstdint>

namespace indet::exact {

/// Arithmetic modulo a prime p < 2^62, by Montgomery's multiplication (Math. Comp. 44, 519 (1985)).
///
/// Numbers come in two forms: plain, a in [0, p), and scaled, a·2^64 mod p. The product of a scaled and a
/// plain number is plain, so a matrix is kept scaled, its right-hand sides plain, and nothing is converted in
/// between.
class PrimeField {
 public:
  /// Precondition: p is an odd prime below 2^62.
  explicit PrimeField(std::uint64_t p);

  std::uint64_t prime() const { return p_; }

  std::uint64_t subtract(std::uint64_t a, std::uint64_t b) const { return a >= b ? a - b : a + p_ - b; }
  /// scaled · plain → plain; scaled · scaled → scaled.
  std::uint64_t multiply(std::uint64_t a, std::uint64_t b) const {
    const Wide product = static_cast<Wide>(a) * b;
    const std::uint64_t m = static_cast<std::uint64_t>(product) * inverse_;
    const auto high = static_cast<std::uint64_t>((product + static_cast<Wide>(m) * p_) >> 64U);
    return high >= p_ ? high - p_ : high;
  }
  std::uint64_t scaled(std::uint64_t plain) const { return multiply(plain, square_); }
  /// The scaled form of 1/a for a scaled a ≠ 0.
  std::uint64_t inverse(std::uint64_t scaled) const;
  /// The plain form of an integer.
  std::uint64_t reduce(const mpz_class& value) const { return mpz_fdiv_ui(value.get_mpz_t(), p_); }

 private:
  __extension__ typedef unsigned __int128 Wide;
  std::uint64_t p_;
  std::uint64_t inverse_ = 0;  ///< −1/p mod 2^64
  std::uint64_t square_ = 0;   ///< 2^128 mod p
};

/// The k-th largest prime below 2^62, k = 0, 1, …
std::uint64_t large_prime(int k);

}  // namespace indet::exact
