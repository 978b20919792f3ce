#include "libindet/barrier/basis_factor.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>

#include "libindet/base/random.h"
#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

using test::packings;
using test::StrengthSet;

/// Columns of A that are independent, one a row.
std::vector<int> independent_columns(const Eigen::MatrixXd& A) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
  std::vector<int> columns;
  for (Eigen::Index k = 0; k < A.rows(); ++k)
    columns.push_back(static_cast<int>(lu.permutationQ().indices()[k]));
  return columns;
}

Eigen::MatrixXd basis_matrix(const Eigen::MatrixXd& A, const std::vector<int>& basis) {
  Eigen::MatrixXd B(A.rows(), A.rows());
  for (Eigen::Index p = 0; p < B.cols(); ++p) B.col(p) = A.col(basis[static_cast<std::size_t>(p)]);
  return B;
}

/// Both kinds of equations against a dense factor.
void expect_solves(const BasisFactor& factor, const Eigen::MatrixXd& A, Random& random) {
  const Eigen::MatrixXd B = basis_matrix(A, factor.basis());
  Eigen::VectorXd load(A.rows());
  for (double& value : load) value = random.uniform(-1, 1);
  const Eigen::PartialPivLU<Eigen::MatrixXd> dense(B);
  std::vector<double> r(load.begin(), load.end()), c = r;
  factor.solve(r);
  factor.solve_transposed(c);
  const Eigen::VectorXd x = dense.solve(load), y = dense.transpose().solve(load);
  EXPECT_LE((test::vector(r) - x).cwiseAbs().maxCoeff(), 1e-9 * (1 + x.cwiseAbs().maxCoeff()));
  EXPECT_LE((test::vector(c) - y).cwiseAbs().maxCoeff(), 1e-9 * (1 + y.cwiseAbs().maxCoeff()));
}

TEST(BasisFactor, SolvesAsADenseFactorDoesAfterManyExchanges) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const StrengthSet set(packing);
    const Eigen::MatrixXd A = set.matrix();
    BasisFactor factor(set.structure);
    ASSERT_FALSE(factor.factor(independent_columns(A)));
    Random random(1);
    expect_solves(factor, A, random);
    int exchanged = 0;
    for (int k = 0; k < 200; ++k) {
      const int entering = static_cast<int>(random.uniform() * static_cast<double>(A.cols()));
      const std::vector<int>& basis = factor.basis();
      if (std::find(basis.begin(), basis.end(), entering) != basis.end()) continue;
      // Any place whose column can be given up for it.
      std::vector<double> along(A.col(entering).begin(), A.col(entering).end());
      factor.solve(along);
      const int p = static_cast<int>(random.uniform() * static_cast<double>(A.rows()));
      if (std::abs(along[static_cast<std::size_t>(p)]) < 0.1) continue;
      ASSERT_TRUE(factor.replace(p, entering, along));
      EXPECT_EQ(factor.basis()[static_cast<std::size_t>(p)], entering);
      ++exchanged;
    }
    expect_solves(factor, A, random);
    EXPECT_GT(exchanged, A.cols() > A.rows() + 20 ? 5 : -1);
  }
}

TEST(BasisFactor, SaysWhichColumnsAreDependent) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const StrengthSet set(packing);
    const Eigen::MatrixXd A = set.matrix();
    if (A.rows() < 6) continue;
    std::vector<int> basis = independent_columns(A);
    BasisFactor factor(set.structure);
    ASSERT_FALSE(factor.factor(basis));
    std::vector<double> along(A.col(basis[1]).begin(), A.col(basis[1]).end());
    factor.solve(along);
    EXPECT_FALSE(factor.replace(0, basis[1], along));
    basis[0] = basis[1];
    basis[4] = basis[5];
    // Unit vectors make it regular, one after the other; the first comes in place of one of these columns.
    int replaced = 0;
    for (auto next = factor.factor(basis); next; next = factor.factor(basis)) {
      EXPECT_TRUE(replaced > 0 || next->column == 0 || next->column == 1 || next->column == 4 ||
                  next->column == 5);
      ASSERT_LT(replaced, 10);
      ++replaced;
      basis[static_cast<std::size_t>(next->column)] = factor.unit_column(next->row);
    }
    EXPECT_GE(replaced, 2);
  }
}

}  // namespace
}  // namespace indet::barrier
