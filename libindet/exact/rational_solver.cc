#include "libindet/exact/rational_solver.h"

#include <algorithm>
#include <optional>

namespace indet::exact {
namespace {

/// Σ digits[i] p^(i − first) over [first, last), by halves.
mpz_class combine(const std::vector<std::uint64_t>& digits, std::size_t first, std::size_t last,
                  const std::vector<mpz_class>& powers) {
  if (last - first == 1) return mpz_class(static_cast<unsigned long>(digits[first]));
  std::size_t level = 0;
  while ((std::size_t{2} << level) < last - first) ++level;
  const std::size_t middle = first + (std::size_t{1} << level);
  return combine(digits, first, middle, powers) + powers[level] * combine(digits, middle, last, powers);
}

/// n/d = a modulo m with |n|, d ≤ √(m/2), by Euclid's algorithm (Wang, SYMSAC 1981), or nothing.
struct Fraction {
  mpz_class numerator, denominator;
};
std::optional<Fraction> reconstruct(const mpz_class& a, const mpz_class& modulus, const mpz_class& bound) {
  mpz_class previous = modulus;
  mpz_class rest = a;
  mpz_class previous_factor = 0;
  mpz_class factor = 1;
  mpz_class quotient;
  mpz_class next;
  while (rest > bound) {
    mpz_tdiv_qr(quotient.get_mpz_t(), next.get_mpz_t(), previous.get_mpz_t(), rest.get_mpz_t());
    std::swap(previous, rest);
    std::swap(rest, next);
    mpz_submul(previous_factor.get_mpz_t(), quotient.get_mpz_t(), factor.get_mpz_t());
    std::swap(previous_factor, factor);
  }
  if (abs(factor) > bound || factor == 0) return {};
  if (factor < 0) return Fraction{-rest, -factor};
  return Fraction{rest, factor};
}

/// The digits of all entries of a p-adic vector, and what can be read from them.
class PadicVector {
 public:
  PadicVector(std::size_t size, std::uint64_t prime) : digits_(size), prime_(prime), values_(size) {
    powers_.emplace_back(static_cast<unsigned long>(prime));
  }

  void append(const std::vector<std::uint64_t>& digit) {
    for (std::size_t i = 0; i < digits_.size(); ++i) digits_[i].push_back(digit[i]);
  }

  std::optional<RationalVector> read() {
    const std::size_t last = digits_.empty() ? 0 : digits_[0].size();
    while ((std::size_t{1} << powers_.size()) < last) powers_.push_back(powers_.back() * powers_.back());
    mpz_class modulus;
    mpz_ui_pow_ui(modulus.get_mpz_t(), prime_, last);
    mpz_class shift;
    mpz_ui_pow_ui(shift.get_mpz_t(), prime_, known_);
    for (std::size_t i = 0; i < digits_.size(); ++i)
      values_[i] += shift * combine(digits_[i], known_, last, powers_);
    known_ = last;
    mpz_class bound = modulus / 2;
    mpz_sqrt(bound.get_mpz_t(), bound.get_mpz_t());

    RationalVector result;
    result.numerator.resize(digits_.size());
    // Entries that could not be read last time fail soonest.
    if (stubborn_ > 0 && !reconstruct(values_[stubborn_], modulus, bound)) return {};
    const mpz_class half = modulus / 2;
    mpz_class numerator;
    for (std::size_t i = 0; i < digits_.size(); ++i) {
      numerator = values_[i] * result.denominator;
      mpz_mod(numerator.get_mpz_t(), numerator.get_mpz_t(), modulus.get_mpz_t());
      if (numerator > half) numerator -= modulus;
      if (abs(numerator) > bound) {
        if (numerator < 0) numerator += modulus;
        const auto fraction = reconstruct(numerator, modulus, bound);
        if (!fraction || fraction->denominator * result.denominator > bound) {
          stubborn_ = i;
          return {};
        }
        for (std::size_t k = 0; k < i; ++k) result.numerator[k] *= fraction->denominator;
        result.denominator *= fraction->denominator;
        numerator = fraction->numerator;
      }
      result.numerator[i] = numerator;
    }
    return result;
  }

 private:
  std::vector<std::vector<std::uint64_t>> digits_;
  std::uint64_t prime_;
  std::vector<mpz_class> values_;  ///< of the first `known_` digits
  std::size_t known_ = 0;
  std::size_t stubborn_ = 0;
  std::vector<mpz_class> powers_;  ///< p^(2^j)
};

}  // namespace

RationalSolver::RationalSolver(std::vector<const IntegerColumn*> columns, std::uint64_t prime)
    : columns_(std::move(columns)), field_(prime), lu_(field_, static_cast<int>(columns_.size()), columns_) {}

std::unique_ptr<RationalSolver> RationalSolver::create(std::vector<const IntegerColumn*> columns) {
  constexpr int kPrimes = 3;
  for (int k = 0; k < kPrimes; ++k) {
    std::unique_ptr<RationalSolver> solver(new RationalSolver(columns, large_prime(k)));
    if (solver->lu_.rank() == static_cast<int>(columns.size())) return solver;
  }
  return nullptr;
}

void RationalSolver::subtract_product(const std::vector<std::uint64_t>& x, bool transposed,
                                      std::vector<mpz_class>& right) const {
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const IntegerColumn& column = *columns_[j];
    for (std::size_t k = 0; k < column.row.size(); ++k) {
      const auto i = static_cast<std::size_t>(column.row[k]);
      const std::size_t from = transposed ? i : j;
      const std::size_t to = transposed ? j : i;
      if (x[from] != 0) mpz_submul_ui(right[to].get_mpz_t(), column.value[k].get_mpz_t(), x[from]);
    }
  }
}

bool RationalSolver::holds(const RationalVector& x, bool transposed,
                           const std::vector<mpz_class>& right) const {
  std::vector<mpz_class> rest(right.size());
  for (std::size_t i = 0; i < right.size(); ++i) rest[i] = right[i] * x.denominator;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const IntegerColumn& column = *columns_[j];
    for (std::size_t k = 0; k < column.row.size(); ++k) {
      const auto i = static_cast<std::size_t>(column.row[k]);
      rest[transposed ? j : i] -= column.value[k] * x.numerator[transposed ? i : j];
    }
  }
  return std::all_of(rest.begin(), rest.end(), [](const mpz_class& value) { return value == 0; });
}

RationalVector RationalSolver::lift(const std::vector<mpz_class>& right, bool transposed) const {
  const std::size_t n = columns_.size();
  std::vector<mpz_class> rest = right;
  std::vector<std::uint64_t> reduced(n);
  PadicVector digits(n, field_.prime());
  if (n == 0) return {};
  std::size_t checkpoint = 2;
  for (std::size_t step = 1;; ++step) {
    for (std::size_t i = 0; i < n; ++i) reduced[i] = field_.reduce(rest[i]);
    const std::vector<std::uint64_t> digit = transposed ? lu_.solve_transposed(reduced) : lu_.solve(reduced);
    digits.append(digit);
    subtract_product(digit, transposed, rest);
    for (mpz_class& value : rest) mpz_divexact_ui(value.get_mpz_t(), value.get_mpz_t(), field_.prime());
    if (step < checkpoint) continue;
    checkpoint += std::max<std::size_t>(2, checkpoint / 3);
    if (auto result = digits.read(); result && holds(*result, transposed, right)) return std::move(*result);
  }
}

RationalVector RationalSolver::solve(const std::vector<mpz_class>& b) const { return lift(b, false); }

RationalVector RationalSolver::solve_transposed(const std::vector<mpz_class>& c) const {
  return lift(c, true);
}

}  // namespace indet::exact
