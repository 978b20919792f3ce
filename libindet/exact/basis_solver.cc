#include "libindet/exact/basis_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/exact/enclosure.h"

namespace indet::exact {
namespace {

mpz_class shifted(const mpz_class& value, long power) {
  mpz_class result;
  if (power >= 0) {
    result = value << static_cast<mp_bitcnt_t>(power);
  } else {
    mpz_fdiv_q_2exp(result.get_mpz_t(), value.get_mpz_t(), static_cast<mp_bitcnt_t>(-power));
  }
  return result;
}

/// The double nearest to every number from low to high, times 2^power, if it is a normal one and the same for
/// all of them. Precondition: 0 < low ≤ high.
std::optional<double> common_nearest(const mpz_class& low, const mpz_class& high, long power) {
  constexpr long kDigits = 53;
  constexpr long kLargestPower = 900;
  // One binary digit more than a double has tells, cut off, which neighbour is nearer, but for a tie.
  const long below = static_cast<long>(mpz_sizeinbase(high.get_mpz_t(), 2)) - kDigits - 1;
  if (below < 1 || std::abs(below + power) > kLargestPower) return {};
  const mpz_class cut = shifted(low, -below);
  const bool is_up = mpz_odd_p(cut.get_mpz_t()) != 0;
  if (cut != shifted(high, -below)) return {};
  if (is_up && mpz_scan1(low.get_mpz_t(), 0) >= static_cast<mp_bitcnt_t>(below)) return {};
  return std::ldexp(mpz_class(is_up ? cut + 1 : cut).get_d(), static_cast<int>(below + power));
}

bool is_power_of_two(const mpz_class& number) {
  return mpz_scan1(number.get_mpz_t(), 0) + 1 == mpz_sizeinbase(number.get_mpz_t(), 2);
}

/// Whether no double lies between two numbers or on them, nor half way between two doubles.
bool round_alike(const mpq_class& lower, const mpq_class& upper) {
  const Enclosure first = enclose(lower);
  const Enclosure last = enclose(upper);
  return first.lower < first.upper && first.lower == last.lower && first.upper == last.upper &&
         std::isfinite(first.lower) && std::isfinite(first.upper) && nearest(lower) == nearest(upper);
}

}  // namespace

Solution::Solution(const BasisSolver& solver, std::vector<mpz_class> right, bool transposed)
    : solver_(&solver),
      right_(std::move(right)),
      transposed_(transposed),
      reached_(solver.blocks_.reached(right_, transposed)) {
  const RefinedSolver* refined = solver.refined_.get();
  if (refined) enclosed_ = transposed ? refined->solve_transposed(right_) : refined->solve(right_);
}

const RationalVector& Solution::exact_on(const BlockForm::Blocks& blocks) const {
  const std::scoped_lock lock(known_->in_use);
  auto known = known_->solutions.find(blocks);
  if (known == known_->solutions.end())
    known = known_->solutions.emplace(blocks, solver_->solve_exactly(right_, transposed_, blocks)).first;
  return known->second;
}

const RationalVector& Solution::exact() const { return exact_on(reached_); }

bool Solution::is_rational() const {
  const std::scoped_lock lock(known_->in_use);
  return !known_->solutions.empty();
}

Solution::Ball Solution::ball(const IntegerColumn& terms) const {
  Ball ball;
  for (std::size_t k = 0; k < terms.row.size(); ++k) {
    const auto i = static_cast<std::size_t>(terms.row[k]);
    if (enclosed_->vanishes[i]) continue;
    mpz_addmul(ball.centre.get_mpz_t(), terms.value[k].get_mpz_t(), enclosed_->centre[i].get_mpz_t());
    ball.radius += abs(terms.value[k]);
  }
  ball.radius *= enclosed_->radius;
  return ball;
}

int Solution::compare(const IntegerColumn& terms, const mpq_class& number) const {
  if (enclosed_) {
    Ball at = ball(terms);
    if (number != 0) {
      // Everything times the denominator, and in the smaller of both units.
      at.centre *= number.get_den();
      at.radius *= number.get_den();
      const long power = terms.shift - enclosed_->exponent;
      if (power >= 0) {
        at.centre -= shifted(number.get_num(), power);
      } else {
        at.centre = shifted(at.centre, -power) - number.get_num();
        at.radius = shifted(at.radius, -power);
      }
    }
    if (at.radius == 0 || mpz_cmpabs(at.centre.get_mpz_t(), at.radius.get_mpz_t()) > 0) return sgn(at.centre);
  }
  return sgn(mpq_class(value({terms, 1}) - number));
}

mpq_class Solution::value(const LinearForm& form) const {
  BlockForm::Blocks blocks = solver_->blocks_.needed(form.terms.row, transposed_);
  for (std::size_t k = 0; k < blocks.size(); ++k) blocks[k] = blocks[k] && reached_[k];
  if (std::none_of(blocks.begin(), blocks.end(), [](bool is_needed) { return is_needed; })) return 0;
  const RationalVector& x = exact_on(blocks);
  mpz_class sum = 0;
  for (std::size_t k = 0; k < form.terms.row.size(); ++k)
    sum += form.terms.value[k] * x.numerator[static_cast<std::size_t>(form.terms.row[k])];
  mpq_class value(sum, x.denominator * form.divisor);
  value.canonicalize();
  return scaled(value, -form.terms.shift);
}

Solution::Bounds Solution::bounds(const IntegerColumn& terms) const {
  if (!enclosed_) {
    const mpq_class value = this->value({terms, 1});
    return {value, value};
  }
  const Ball at = ball(terms);
  const long power = enclosed_->exponent - terms.shift;
  return {scaled(at.centre - at.radius, power), scaled(at.centre + at.radius, power)};
}

mpq_class Solution::stand_in(const LinearForm& form) const {
  if (enclosed_) {
    const auto [lower, upper] = bounds(form.terms);
    if (lower == upper || round_alike(lower / form.divisor, upper / form.divisor))
      return (lower + upper) / (2 * form.divisor);
  }
  return value(form);
}

double Solution::nearest(const LinearForm& form) const {
  if (enclosed_ && is_power_of_two(form.divisor)) {
    const Ball at = ball(form.terms);
    if (at.centre == 0 && at.radius == 0) return 0;
    const mpz_class size = abs(at.centre);
    if (size > at.radius) {
      const auto divided = static_cast<long>(mpz_scan1(form.divisor.get_mpz_t(), 0));
      const auto found = common_nearest(size - at.radius, size + at.radius,
                                        enclosed_->exponent - form.terms.shift - divided);
      if (found) return sgn(at.centre) * *found;
    }
  }
  return exact::nearest(stand_in(form));
}

std::unique_ptr<BasisSolver> BasisSolver::create(std::vector<const IntegerColumn*> columns) {
  std::unique_ptr<BasisSolver> solver(new BasisSolver(std::move(columns)));
  if (!solver->columns_.empty()) solver->refined_ = RefinedSolver::create(solver->columns_);
  if (solver->refined_) {
    solver->blocks_ = solver->refined_->blocks();
    return solver;
  }
  const BlockForm::Blocks all(1, true);
  auto whole = solver->part_of(all);
  if (!whole->solver) return nullptr;
  solver->parts_.emplace(all, std::move(whole));
  return solver;
}

std::unique_ptr<BasisSolver::Part> BasisSolver::part_of(const BlockForm::Blocks& blocks) const {
  auto part = std::make_unique<Part>();
  std::vector<int> number(columns_.size(), -1);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!blocks[static_cast<std::size_t>(blocks_.of_row(i))]) continue;
    number[i] = static_cast<int>(part->rows.size());
    part->rows.push_back(i);
  }
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    if (!blocks[static_cast<std::size_t>(blocks_.of_column(j))]) continue;
    part->columns.push_back(j);
    IntegerColumn& own = part->entries.emplace_back();
    own.shift = columns_[j]->shift;
    for (std::size_t k = 0; k < columns_[j]->row.size(); ++k) {
      const int row = number[static_cast<std::size_t>(columns_[j]->row[k])];
      if (row < 0) continue;
      own.row.push_back(row);
      own.value.push_back(columns_[j]->value[k]);
    }
  }
  std::vector<const IntegerColumn*> pointers;
  for (const IntegerColumn& column : part->entries) pointers.push_back(&column);
  part->solver = RationalSolver::create(std::move(pointers));
  return part;
}

/// RationalSolver has integer columns: x_j · 2^−shift, or equations times 2^shift, in place of the true ones.
RationalVector BasisSolver::solve_exactly(const std::vector<mpz_class>& right, bool transposed,
                                          const BlockForm::Blocks& blocks) const {
  const Part* part = nullptr;
  {
    const std::scoped_lock lock(parts_in_use_);
    auto& known = parts_[blocks];
    if (!known) known = part_of(blocks);
    part = known.get();
  }
  if (!part->solver) throw LibraryError("a determinant has several prime factors next to 2^62");
  long least = 0;
  for (const IntegerColumn& column : part->entries) least = std::min(least, column.shift);
  const auto shift = [&](std::size_t j) { return static_cast<mp_bitcnt_t>(part->entries[j].shift - least); };
  std::vector<mpz_class> own;
  for (const std::size_t i : transposed ? part->columns : part->rows) own.push_back(right[i]);
  RationalVector solved;
  if (transposed) {
    for (std::size_t j = 0; j < own.size(); ++j) own[j] <<= shift(j);
    solved = part->solver->solve_transposed(own);
  } else {
    solved = part->solver->solve(own);
    for (std::size_t j = 0; j < own.size(); ++j) solved.numerator[j] <<= shift(j);
  }
  RationalVector x;
  x.numerator.resize(right.size());
  x.denominator = solved.denominator << static_cast<mp_bitcnt_t>(-least);
  const std::vector<std::size_t>& unknowns = transposed ? part->rows : part->columns;
  for (std::size_t k = 0; k < unknowns.size(); ++k) x.numerator[unknowns[k]] = std::move(solved.numerator[k]);
  return x;
}

}  // namespace indet::exact
