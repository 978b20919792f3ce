#include "libindet/exact/rational_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "libindet/exact/enclosure.h"
#include "tests/exact/random_matrix.h"

namespace indet::exact {
namespace {

TEST(PrimeField, AgreesWithGmp) {
  const PrimeField field(large_prime(0));
  EXPECT_EQ(large_prime(0), 4611686018427387847U);  // 2^62 − 57
  const mpz_class p(static_cast<unsigned long>(field.prime()));
  std::uint64_t a = 1;
  for (int step = 0; step < 1000; ++step) {
    a = (a * 6364136223846793005U + 1442695040888963407U);
    const std::uint64_t x = a % field.prime();
    const std::uint64_t y = (a >> 3U) % field.prime();
    const mpz_class product = mpz_class(static_cast<unsigned long>(x)) * static_cast<unsigned long>(y) % p;
    ASSERT_EQ(field.multiply(field.scaled(x), y), product.get_ui());
    ASSERT_EQ(field.multiply(field.scaled(x), field.multiply(field.inverse(field.scaled(x)), y)), y);
    ASSERT_EQ(field.subtract(x, y),
              mpz_class((mpz_class(static_cast<unsigned long>(x)) + p - static_cast<unsigned long>(y)) % p)
                  .get_ui());
  }
  EXPECT_EQ(field.reduce(-1), field.prime() - 1);
}

TEST(RationalSolver, InvertsHilbertsMatrix) {
  // 2520 H, 1 / (i + j + 1): its inverse is known to be integer; H⁻¹ e_0 for n = 5 is (25, −300, 1050, −1400,
  // 630).
  std::vector<IntegerColumn> columns(5);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      columns[static_cast<std::size_t>(j)].row.push_back(i);
      columns[static_cast<std::size_t>(j)].value.emplace_back(2520 / (i + j + 1));
    }
  }
  const auto solver = RationalSolver::create(pointers_to(columns));
  ASSERT_TRUE(solver);
  const RationalVector x = solver->solve({2520, 0, 0, 0, 0});
  const long expected[] = {25, -300, 1050, -1400, 630};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(x[i], expected[i]);
}

TEST(RationalSolver, MultipliesBack) {
  for (const int size : {1, 2, 7, 40}) {
    const auto columns = random_matrix(size, 4, static_cast<std::uint64_t>(size));
    const auto solver = RationalSolver::create(pointers_to(columns));
    ASSERT_TRUE(solver);
    std::vector<mpz_class> right;
    for (int i = 0; i < size; ++i) right.emplace_back(3 * i * i - 50);
    const RationalVector x = solver->solve(right);
    const RationalVector y = solver->solve_transposed(right);
    std::vector<mpq_class> product(static_cast<std::size_t>(size), 0);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      mpq_class transposed = 0;
      for (std::size_t k = 0; k < columns[j].row.size(); ++k) {
        const auto i = static_cast<std::size_t>(columns[j].row[k]);
        product[i] += columns[j].value[k] * x[j];
        transposed += columns[j].value[k] * y[i];
      }
      EXPECT_EQ(transposed, right[j]);
    }
    for (std::size_t i = 0; i < product.size(); ++i) EXPECT_EQ(product[i], right[i]);
  }
}

TEST(RationalSolver, RefusesASingularMatrix) {
  auto columns = random_matrix(6, 3, 1);
  columns[4] = columns[2];
  EXPECT_FALSE(RationalSolver::create(pointers_to(columns)));
  const PrimeField field(large_prime(0));
  EXPECT_EQ(ModularLu(field, 6, pointers_to(columns)).rank(), 5);
}

TEST(Enclosure, IsTwoNeighbours) {
  const Enclosure third = enclose(mpq_class(1, 3));
  EXPECT_EQ(std::nextafter(third.lower, 1), third.upper);
  EXPECT_LT(mpq_class(third.lower), mpq_class(1, 3));
  EXPECT_GT(mpq_class(third.upper), mpq_class(1, 3));
  const Enclosure negative = enclose(mpq_class(-1, 3));
  EXPECT_EQ(negative.lower, -third.upper);
  EXPECT_EQ(negative.upper, -third.lower);
  EXPECT_EQ(enclose(mpq_class(3, 4)).lower, 0.75);
  EXPECT_EQ(enclose(mpq_class(3, 4)).upper, 0.75);
  const mpq_class huge(mpz_class(1) << 2000U);
  EXPECT_EQ(enclose(huge).upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(enclose(huge).lower, std::numeric_limits<double>::max());
  // Below the smallest double.
  const mpq_class tiny(1, mpz_class(1) << 2000U);
  EXPECT_EQ(enclose(tiny).lower, 0);
  EXPECT_EQ(enclose(tiny).upper, std::numeric_limits<double>::denorm_min());
}

}  // namespace
}  // namespace indet::exact
