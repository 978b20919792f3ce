#include "libindet/exact/refined_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/base/rounding_bounds.h"

namespace indet::exact {
namespace {

/// Rows of the inverse that are looked at together.
constexpr std::size_t kPanel = 16;
/// Small pivots make an inexact inverse.
constexpr double kLeastShare = 0.5;
/// Above this the inverse is of no use.
constexpr double kLargestInverse = 0x1p60;
/// Residuals of so many units of fixed point are rounding of the last correction.
constexpr long kLastBits = 4;

/// value · 2^power to a few last places.
double rounded(const mpz_class& value, long power) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(std::clamp(exponent + power, -2000L, 2000L)));
}

/// value · 2^power, cut off at units.
mpz_class fixed(double value, long power) {
  constexpr int kDigits = 53;
  int exponent = 0;
  mpz_class result(std::ldexp(std::frexp(value, &exponent), kDigits));
  const long shift = exponent - kDigits + power;
  if (shift >= 0) return result << static_cast<mp_bitcnt_t>(shift);
  mpz_tdiv_q_2exp(result.get_mpz_t(), result.get_mpz_t(), static_cast<mp_bitcnt_t>(-shift));
  return result;
}

long most_bits(const std::vector<mpz_class>& numbers) {
  std::size_t bits = 0;
  for (const mpz_class& number : numbers) {
    if (number != 0) bits = std::max(bits, mpz_sizeinbase(number.get_mpz_t(), 2));
  }
  return static_cast<long>(bits);
}

}  // namespace

RefinedSolver::RefinedSolver(std::vector<const IntegerColumn*> columns)
    : columns_(std::move(columns)), lu_(kLeastShare) {
  first_.push_back(0);
  most_shift_ = columns_.front()->shift;
  for (const IntegerColumn* column : columns_) {
    most_shift_ = std::max(most_shift_, column->shift);
    for (std::size_t k = 0; k < column->row.size(); ++k) {
      rows_.push_back(column->row[k]);
      entries_.push_back(rounded(column->value[k], -column->shift));
    }
    first_.push_back(static_cast<int>(rows_.size()));
  }
}

std::unique_ptr<RefinedSolver> RefinedSolver::create(std::vector<const IntegerColumn*> columns) {
  std::unique_ptr<RefinedSolver> solver(new RefinedSolver(std::move(columns)));
  const bool is_finite = std::all_of(solver->entries_.begin(), solver->entries_.end(),
                                     [](double entry) { return std::isfinite(entry); });
  if (!is_finite || solver->lu_.factor(solver->first_, solver->rows_, solver->entries_)) return nullptr;
  if (!solver->bound_inverse()) return nullptr;
  solver->blocks_ = BlockForm(solver->columns_, solver->lu_.blocks());
  return solver;
}

/// ‖·‖∞ is the largest sum over a row, ‖·‖₁ = ‖·ᵀ‖∞ over a column. Entries of B are off by their last place
/// or, the smallest ones, by what is lost in underflow.
bool RefinedSolver::bound_inverse() {
  const std::size_t n = columns_.size();
  std::vector<double> inverse_columns(n, 0);
  std::vector<double> defect_columns(n, 0);
  double inverse_row = 0;
  double defect_row = 0;
  std::vector<double> panel;
  for (std::size_t first = 0; first < n; first += kPanel) {
    const std::size_t count = std::min(kPanel, n - first);
    panel.assign(count * n, 0);
    for (std::size_t k = 0; k < count; ++k) panel[k * n + first + k] = 1;
    lu_.solve_transposed(panel);
    for (std::size_t k = 0; k < count; ++k) {
      const double* const row = panel.data() + k * n;
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) {
        sum += std::abs(row[i]);
        inverse_columns[i] += std::abs(row[i]);
      }
      inverse_row = std::max(inverse_row, sum);
      if (!(sum < kLargestInverse)) return false;
      double defect = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double unit = j == first + k ? 1 : 0;
        double dot = -unit;
        double size = unit;
        for (int at = first_[j]; at < first_[j + 1]; ++at) {
          const double product =
              row[rows_[static_cast<std::size_t>(at)]] * entries_[static_cast<std::size_t>(at)];
          dot += product;
          size += std::abs(product);
        }
        const double bound = std::abs(dot) + (first_[j + 1] - first_[j] + 4) * kRoundoff * size + kTiny;
        defect += bound;
        defect_columns[j] += bound;
      }
      defect_row = std::max(defect_row, defect);
    }
  }
  const double widen = 1 + 8 * static_cast<double>(n) * kRoundoff;  // rounding of sums of n positive terms
  const double inverse_column = *std::max_element(inverse_columns.begin(), inverse_columns.end());
  const double defect_column = *std::max_element(defect_columns.begin(), defect_columns.end());
  if (!(widen * std::max(defect_row, defect_column) < 0.5) || !(inverse_column < kLargestInverse))
    return false;
  norm_ = widen * inverse_row / (1 - widen * defect_row);
  transposed_norm_ = widen * inverse_column / (1 - widen * defect_column);
  return true;
}

/// right · 2^left_shift − 2^most_shift_ B x.
std::vector<mpz_class> RefinedSolver::residual(const std::vector<mpz_class>& right, long left_shift,
                                               const std::vector<mpz_class>& x, bool transposed) const {
  std::vector<mpz_class> rest;
  rest.reserve(right.size());
  for (const mpz_class& entry : right) rest.emplace_back(entry << static_cast<mp_bitcnt_t>(left_shift));
  mpz_class moved;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const IntegerColumn& column = *columns_[j];
    const auto shift = static_cast<mp_bitcnt_t>(most_shift_ - column.shift);
    if (transposed) {
      moved = 0;
      for (std::size_t k = 0; k < column.row.size(); ++k)
        mpz_addmul(moved.get_mpz_t(), column.value[k].get_mpz_t(),
                   x[static_cast<std::size_t>(column.row[k])].get_mpz_t());
      rest[j] -= moved << shift;
    } else if (x[j] != 0) {
      moved = x[j] << shift;
      for (std::size_t k = 0; k < column.row.size(); ++k)
        mpz_submul(rest[static_cast<std::size_t>(column.row[k])].get_mpz_t(), column.value[k].get_mpz_t(),
                   moved.get_mpz_t());
    }
  }
  return rest;
}

std::optional<EnclosedVector> RefinedSolver::refine(const std::vector<mpz_class>& right,
                                                    bool transposed) const {
  const std::size_t n = columns_.size();
  EnclosedVector x;
  x.centre.resize(n);
  const BlockForm::Blocks reached = blocks_.reached(right, transposed);
  for (std::size_t i = 0; i < n; ++i)
    x.vanishes.push_back(!reached[static_cast<std::size_t>(blocks_.of_unknown(i, transposed))]);
  const long size = most_bits(right);
  if (size == 0) return x;
  x.exponent = std::min(size - kBits, most_shift_);
  std::vector<double> step(n);
  for (long before = 0;;) {
    const std::vector<mpz_class> rest = residual(right, most_shift_ - x.exponent, x.centre, transposed);
    const long bits = most_bits(rest);
    if (bits <= most_shift_ + kLastBits || (before > 0 && bits + kLastBits > before)) {
      const long power = bits - most_shift_;  // ‖r‖∞ < 2^power units
      if (bits > 0) x.radius = fixed(transposed ? transposed_norm_ : norm_, power) + 1;
      return x;
    }
    before = bits;
    for (std::size_t i = 0; i < n; ++i) step[i] = rounded(rest[i], -bits);
    {
      const std::scoped_lock lock(lu_in_use_);
      transposed ? lu_.solve_transposed(step) : lu_.solve(step);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(step[i])) return {};
      if (!x.vanishes[i]) x.centre[i] += fixed(step[i], bits - most_shift_);
    }
  }
}

}  // namespace indet::exact
