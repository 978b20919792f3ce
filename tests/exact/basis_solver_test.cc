#include "libindet/exact/basis_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/exact/enclosure.h"
#include "tests/exact/random_matrix.h"

namespace indet::exact {
namespace {

std::vector<mpz_class> some_numbers(int size) {
  std::vector<mpz_class> numbers;
  for (int i = 0; i < size; ++i) numbers.emplace_back(3 * i * i - 50);
  return numbers;
}

/// Columns of which the last is the one before, but for a hair of 2^−bits in its last entry.
std::vector<IntegerColumn> hairline_matrix(int size, unsigned bits) {
  std::vector<IntegerColumn> columns = random_matrix(size, 4, 5);
  IntegerColumn& last = columns.back();
  last = columns[columns.size() - 2];
  for (mpz_class& value : last.value) value <<= bits;
  last.value.back() += columns[columns.size() - 2].value.back();
  last.shift = bits;
  return columns;
}

mpq_class in_units(const mpq_class& number, const EnclosedVector& x) { return scaled(number, -x.exponent); }

void expect_enclosed(const EnclosedVector& x, const std::vector<mpq_class>& exact) {
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const mpq_class error = in_units(exact[i], x) - x.centre[i];
    EXPECT_LE(mpq_class(abs(error)), mpq_class(x.radius)) << i;
    if (x.vanishes[i]) {
      EXPECT_EQ(exact[i], 0);
    }
  }
}

TEST(RefinedSolver, EnclosesTheSolutionOfTheNumbersAsTheyAre) {
  // The hair of 20 bits makes the inverse large: there the residual alone says little about the error.
  for (auto columns : {random_matrix(1, 4, 1), random_matrix(40, 4, 40), hairline_matrix(12, 20)}) {
    for (IntegerColumn& column : columns) column.shift += 50;
    const auto pointers = pointers_to(columns);
    const auto refined = RefinedSolver::create(pointers);
    ASSERT_TRUE(refined);
    const auto rational = RationalSolver::create(pointers);
    const std::vector<mpz_class> right = some_numbers(static_cast<int>(columns.size()));
    std::vector<mpz_class> scaled_right;
    std::vector<mpq_class> exact, exact_transposed;
    const RationalVector x = rational->solve(right);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      exact.push_back(scaled(x[j], columns[j].shift));
      scaled_right.push_back(right[j] << static_cast<mp_bitcnt_t>(columns[j].shift));
    }
    const RationalVector y = rational->solve_transposed(scaled_right);
    for (std::size_t i = 0; i < columns.size(); ++i) exact_transposed.push_back(y[i]);
    const auto enclosed = refined->solve(right);
    const auto transposed = refined->solve_transposed(right);
    ASSERT_TRUE(enclosed && transposed);
    expect_enclosed(*enclosed, exact);
    expect_enclosed(*transposed, exact_transposed);
    EXPECT_LT(mpz_sizeinbase(enclosed->radius.get_mpz_t(), 2), 70) << "of 160 bits";
  }
}

TEST(RefinedSolver, DoesNotCallAMatrixRegularThatDoublesCannotTellFromASingularOne) {
  auto columns = random_matrix(6, 3, 1);
  columns[4] = columns[2];
  EXPECT_FALSE(RefinedSolver::create(pointers_to(columns)));
  columns = hairline_matrix(12, 80);
  EXPECT_FALSE(RefinedSolver::create(pointers_to(columns)));
  const auto solver = BasisSolver::create(pointers_to(columns));
  ASSERT_TRUE(solver) << "but it is";
  EXPECT_EQ(solver->solve(std::vector<mpz_class>(12, 0)).sign({{3}, {1}, 0}), 0);
}

/// Sums that cancel to every degree, to none and to nothing: by enclosures or not, the answer is the exact
/// one.
TEST(Solution, AnswersAsRationalNumbersDo) {
  auto columns = random_matrix(20, 4, 3);
  for (IntegerColumn& column : columns) column.shift = 50;
  const auto solver = BasisSolver::create(pointers_to(columns));
  ASSERT_TRUE(solver);
  const std::vector<mpz_class> right = some_numbers(20);
  const RationalVector integer = RationalSolver::create(pointers_to(columns))->solve(right);
  std::vector<mpq_class> x;
  for (std::size_t i = 0; i < 20; ++i) x.push_back(scaled(integer[i], 50));
  int rational = 0;
  for (unsigned bits = 0; bits <= 200; bits += 20) {
    SCOPED_TRACE(bits);
    for (std::size_t i = 0; i + 1 < 20; ++i) {
      const mpq_class unit = scaled(1, bits);
      const auto whole = [](const mpq_class& q) { return mpz_class(q.get_num() / q.get_den()); };
      const mpz_class a = whole(x[i + 1] / abs(x[i]) * unit);
      const mpz_class b = whole(-x[i] / abs(x[i]) * unit);
      const int first = static_cast<int>(i);
      const LinearForm form{{{first, first + 1}, {a, b}, 7}, mpz_class(i % 2 == 0 ? 3 : 8)};
      const mpq_class exact = scaled(a * x[i] + b * x[i + 1], -7);
      const Solution solution = solver->solve(right);
      EXPECT_EQ(solution.sign(form.terms), sgn(exact));
      EXPECT_EQ(solution.compare(form.terms, exact), 0);
      EXPECT_EQ(solution.compare(form.terms, exact * mpq_class(1001, 1000)), -sgn(exact));
      EXPECT_EQ(solution.compare(form.terms, mpq_class(exact + scaled(1, -400))), -1);
      const mpq_class value = exact / form.divisor;
      EXPECT_EQ(solution.value(form), value);
      const Solution other = solver->solve(right);
      EXPECT_EQ(other.nearest(form), nearest(value));
      const mpq_class stand_in = other.stand_in(form);
      EXPECT_EQ(enclose(stand_in).lower, enclose(value).lower);
      EXPECT_EQ(enclose(stand_in).upper, enclose(value).upper);
      EXPECT_EQ(nearest(stand_in), nearest(value));
      rational += other.is_rational() ? 1 : 0;
    }
  }
  EXPECT_GT(rational, 20) << "where 160 bits do not suffice";
  EXPECT_LT(rational, 130) << "of 209";
}

TEST(Solution, RoundsDoublesAndTiesAsTheyAre) {
  // B x = B x₀: what is a double, half way between two, or a little beside it.
  const auto columns = random_matrix(8, 3, 9);
  const auto solver = BasisSolver::create(pointers_to(columns));
  ASSERT_TRUE(solver);
  const mpq_class tie = 1 + scaled(1, -53);
  const std::vector<mpq_class> x0{
      0, 1.1, -1.1, tie, mpq_class(-tie), mpq_class(tie + scaled(1, -90)), tie - scaled(1, -90), 3 * tie};
  std::vector<mpz_class> right(8, 0);
  for (std::size_t j = 0; j < 8; ++j) {
    for (std::size_t k = 0; k < columns[j].row.size(); ++k)
      right[static_cast<std::size_t>(columns[j].row[k])] +=
          mpq_class(columns[j].value[k] * scaled(x0[j], 90)).get_num();
  }
  for (int j = 0; j < 8; ++j) {
    SCOPED_TRACE(j);
    const Solution solution = solver->solve(right);
    const LinearForm form{{{j}, {1}, 90}, 1};
    const mpq_class& value = x0[static_cast<std::size_t>(j)];
    EXPECT_EQ(solution.nearest(form), nearest(value));
    EXPECT_EQ(enclose(solution.stand_in(form)).lower, enclose(value).lower);
    EXPECT_EQ(enclose(solution.stand_in(form)).upper, enclose(value).upper);
    EXPECT_EQ(solution.compare(form.terms, value), 0);
  }
}

/// Two blocks, of which the second enters the first's equations.
TEST(Solution, IsZeroWhereNothingReaches) {
  const auto one = random_matrix(5, 3, 2);
  const auto other = random_matrix(4, 3, 4);
  std::vector<IntegerColumn> columns = one;
  for (IntegerColumn column : other) {
    for (int& row : column.row) row += 5;
    column.row.insert(column.row.begin(), 1);
    column.value.insert(column.value.begin(), 77);
    columns.push_back(std::move(column));
  }
  const auto solver = BasisSolver::create(pointers_to(columns));
  ASSERT_TRUE(solver);
  std::vector<mpz_class> right(9, 0);
  right[2] = 5;
  const Solution first = solver->solve(right);
  const Solution second = solver->solve_transposed([] {
    std::vector<mpz_class> c(9, 0);
    c[7] = 5;
    return c;
  }());
  for (int i = 0; i < 9; ++i) {
    const IntegerColumn unknown{{i}, {1}, 0};
    EXPECT_EQ(first.sign(unknown) == 0, i >= 5) << i;
    EXPECT_EQ(second.sign(unknown) == 0, i < 5) << i;
  }
  EXPECT_FALSE(first.is_rational() || second.is_rational());
  // A part of the solution follows from its own equations alone.
  right[8] = 7;
  const Solution both = solver->solve(right);
  EXPECT_EQ(both.value({{{6}, {1}, 0}, 1}),
            RationalSolver::create(pointers_to(other))->solve({0, 0, 0, 7})[1]);
  EXPECT_EQ(both.value({{{0}, {1}, 0}, 1}), RationalSolver::create(pointers_to(columns))->solve(right)[0]);
}

}  // namespace
}  // namespace indet::exact
