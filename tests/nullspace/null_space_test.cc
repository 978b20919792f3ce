#include "libindet/nullspace/null_space.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/nullspace/sparse_qr.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

Eigen::MatrixXd random_matrix(int rows, int columns, double filled, Random& random) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  for (double& entry : matrix.reshaped())
    if (random.uniform() < filled) entry = random.normal();
  return matrix;
}

/// Against the singular value decomposition: projectors and residuals, never basis vectors.
void expect_as_dense(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& b) {
  const NullSpace found = compute_null_space(matrix.sparseView(), b);
  const oracle::DenseSolution exact = oracle::solve_dense(matrix, b);
  ASSERT_EQ(found.rank, exact.rank);
  ASSERT_EQ(found.nullity, matrix.cols() - exact.rank);
  ASSERT_EQ(found.basis.cols(), found.nullity);
  EXPECT_FALSE(found.ambiguous);
  const Eigen::MatrixXd& Z = found.basis;
  const double scale = std::max(1.0, matrix.norm());
  EXPECT_LE((matrix * Z).norm(), 1e-13 * scale);
  EXPECT_TRUE(test::same_entries(Eigen::MatrixXd::Identity(Z.cols(), Z.cols()), Z.transpose() * Z, 1e-13));
  EXPECT_TRUE(test::same_entries(exact.kernel * exact.kernel.transpose(), Z * Z.transpose(), 1e-9));
  // Independent rows really are, and span the rest.
  ASSERT_EQ(static_cast<int>(found.independent_rows.size()), found.rank);
  EXPECT_TRUE(std::is_sorted(found.independent_rows.begin(), found.independent_rows.end()));
  const Eigen::MatrixXd kept = matrix(found.independent_rows, Eigen::all);
  EXPECT_EQ(oracle::solve_dense(kept, Eigen::VectorXd::Zero(kept.rows())).rank, found.rank);
  const bool balanced = exact.residual < 1e-9;
  EXPECT_EQ(found.unbalanced.size() == 0, balanced);
  if (balanced) {
    EXPECT_LE((matrix * found.particular - b).lpNorm<Eigen::Infinity>(),
              1e-11 * std::max(1.0, found.particular.norm()));
    EXPECT_TRUE(test::same_entries(exact.particular, found.particular, 1e-8));
    EXPECT_LE((Z.transpose() * found.particular).norm(), 1e-12 * std::max(1.0, found.particular.norm()));
  } else {
    EXPECT_LE((matrix.transpose() * found.unbalanced).norm(), 1e-12 * scale * found.unbalanced.norm());
    EXPECT_LT(found.unbalanced.dot(b), -1e-10);
  }
  // P solves the independent equations, with the smallest columns.
  const Eigen::MatrixXd P = right_inverse(found, matrix.sparseView());
  EXPECT_TRUE(test::same_entries(kept * P, Eigen::MatrixXd::Identity(found.rank, found.rank), 1e-9));
  EXPECT_LE((Z.transpose() * P).norm(), 1e-11 * std::max(1.0, P.norm()));
  // The estimates bound the singular values.
  if (found.rank > 0 && matrix.size() > 0) {
    const Eigen::VectorXd sigma = oracle::singular_values(matrix);
    EXPECT_GT(found.smallest_accepted, 1e-3 * sigma[found.rank - 1]);
    EXPECT_LT(found.smallest_accepted, 10 * sigma[0]);
    if (found.rank < sigma.size()) {
      EXPECT_LE(sigma[found.rank], found.largest_rejected + 1e-14 * scale);
    }
  }
}

TEST(NullSpace, AgreesWithDenseSingularValues) {
  Random random(11);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int rows = 1 + static_cast<int>(random.below(12));
    const int columns = 1 + static_cast<int>(random.below(16));
    const Eigen::MatrixXd matrix = random_matrix(rows, columns, random.uniform(0.2, 1), random);
    SCOPED_TRACE(repeat);
    // In the range of the matrix, and anywhere.
    expect_as_dense(matrix, matrix * Eigen::VectorXd::LinSpaced(columns, -1, 1));
    expect_as_dense(matrix, Eigen::VectorXd::LinSpaced(rows, 1, 2));
  }
}

TEST(NullSpace, FindsTheRankOfDeficientMatrices) {
  Random random(12);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const int rank = static_cast<int>(random.below(5));
    const Eigen::MatrixXd left = random_matrix(9, rank, 1, random);
    const Eigen::MatrixXd right = random_matrix(rank, 12, 1, random);
    const Eigen::MatrixXd matrix = left * right;
    SCOPED_TRACE(repeat);
    expect_as_dense(matrix, matrix * Eigen::VectorXd::LinSpaced(12, -1, 1));
    expect_as_dense(matrix, Eigen::VectorXd::Ones(9));
  }
}

TEST(NullSpace, DuplicatedAndZeroRowsAndColumnsAddNothing) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6, 7);
  matrix.row(1) << 1, 2, 0, 0, 3, 0, 1;
  matrix.row(2) = matrix.row(1);
  matrix.row(4) << 0, 1, 1, 0, 0, 0, -1;
  matrix.row(5) = matrix.row(1) - matrix.row(4);
  expect_as_dense(matrix, matrix * Eigen::VectorXd::Ones(7));
  expect_as_dense(matrix, Eigen::VectorXd::Unit(6, 0));
}

TEST(NullSpace, OfNothing) {
  const NullSpace no_rows = compute_null_space(Eigen::SparseMatrix<double>(0, 3), Eigen::VectorXd(0));
  EXPECT_EQ(no_rows.nullity, 3);
  EXPECT_EQ(no_rows.rank, 0);
  const NullSpace no_columns = compute_null_space(Eigen::SparseMatrix<double>(2, 0), Eigen::Vector2d(0, 1));
  EXPECT_EQ(no_columns.nullity, 0);
  EXPECT_EQ(no_columns.unbalanced, Eigen::Vector2d(0, -1));
  const NullSpace zero = compute_null_space(Eigen::SparseMatrix<double>(2, 3), Eigen::Vector2d::Zero());
  EXPECT_EQ(zero.nullity, 3);
  EXPECT_EQ(zero.smallest_accepted, std::numeric_limits<double>::infinity());
}

TEST(NullSpace, OfPilesHasAtLeastTheNullityOfTheCount) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Packing packing = zoo::random_pile(seed, 7, seed % 2 == 0 ? 0.3 : -1);
    const EquilibriumProblem problem = pose_equilibrium(packing);
    SCOPED_TRACE(seed);
    expect_as_dense(problem.matrix, problem.load());
    EXPECT_GE(compute_null_space(problem.matrix, problem.load()).nullity,
              problem.unknowns() - problem.equations());
  }
  const Packing lattice = zoo::lattice_pile(6, 0.3);
  const EquilibriumProblem problem = pose_equilibrium(lattice);
  expect_as_dense(problem.matrix, problem.load());
}

TEST(NullSpace, DoubtfulSingularValuesAreReportedAndDecidedByTheDenseDecomposition) {
  for (const double small : {1e-6, 1e-9, 1e-10, 3e-12, 5e-13, 1e-15}) {
    Eigen::MatrixXd matrix(3, 4);
    matrix << 1, 1, 0, 0.5, 0, 1, 1, 0, 1, 1, 0, 0.5;
    matrix(2, 3) += small;
    const NullSpace found = compute_null_space(matrix.sparseView(), matrix * Eigen::Vector4d(1, 2, 3, 4));
    const Eigen::VectorXd sigma = oracle::singular_values(matrix);
    const bool zero = sigma[2] < tolerance::kRankReject;
    EXPECT_EQ(found.rank, zero ? 2 : 3) << small;
    EXPECT_EQ(found.ambiguous, !zero && small < 1e-11) << small;
    if (found.ambiguous) {
      EXPECT_TRUE(test::same_entries(sigma, found.singular_values, 1e-14));
    }
    EXPECT_LE((matrix * found.basis).norm(), 1e-12) << small;
    EXPECT_EQ(found.unbalanced.size(), 0) << small;
  }
}

TEST(NullSpace, MotionGivesTheWantedRelativeVelocities) {
  Random random(13);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Eigen::MatrixXd matrix = random_matrix(7, 3, 1, random) * random_matrix(3, 10, 1, random);
    const Eigen::VectorXd q = matrix.transpose() * random_matrix(7, 1, 1, random);
    const Eigen::VectorXd b = matrix * random_matrix(10, 1, 1, random);
    const NullSpace null_space = compute_null_space(matrix.sparseView(), b);
    const Eigen::VectorXd v = motion_from_contacts(null_space, 7, q);
    EXPECT_LE((matrix.transpose() * v - q).norm(), 1e-11 * q.norm());
  }
}

TEST(SparseQr, SolvesBothWays) {
  Random random(14);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Eigen::MatrixXd a = random_matrix(10, 4, 1, random) * random_matrix(4, 6, 1, random);
    const SparseQr qr(a.sparseView(), 1e-12 * a.norm());
    ASSERT_EQ(qr.rank(), 4);
    const Eigen::VectorXd b = random_matrix(10, 1, 1, random);
    const Eigen::VectorXd x = qr.solve(b);
    EXPECT_LE((a.transpose() * (a * x - b)).norm(), 1e-10 * a.norm() * b.norm()) << "normal equations";
    const Eigen::VectorXd y = random_matrix(10, 1, 1, random);
    const Eigen::VectorXd smallest = qr.solve_transposed(a.transpose() * y);
    EXPECT_LE((a.transpose() * (smallest - y)).norm(), 1e-11 * a.norm() * y.norm());
    EXPECT_LE((qr.left_kernel().transpose() * smallest).norm(), 1e-11 * y.norm());
  }
}

}  // namespace
}  // namespace indet
