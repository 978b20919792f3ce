#include "libindet/barrier/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libindet/base/random.h"
#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

using test::Named;
using test::packings;
using test::StrengthSet;
using test::vector;

std::vector<double> random_weights(int count, double decades, Random& random) {
  std::vector<double> D;
  for (int k = 0; k < count; ++k) D.push_back(std::pow(10.0, random.uniform(-decades, decades)));
  return D;
}

/// L as a dense matrix.
Eigen::MatrixXd factor_of(const BlockStructure& s, const BlockCholesky& cholesky) {
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(s.rows(), s.rows());
  for (int node = 0; node < s.nodes(); ++node) {
    for (int block = s.first_block(node); block < s.first_block(node + 1); ++block) {
      const int other = s.block_node(block);
      for (int r = 0; r < s.node_rows(other); ++r) {
        for (int q = 0; q < s.node_rows(node); ++q) {
          if (other == node && q > r) continue;
          L(s.first_row(other) + r, s.first_row(node) + q) =
              cholesky.values()[static_cast<std::size_t>(s.block_value(block) + r * s.node_rows(node) + q)];
        }
      }
    }
  }
  return L;
}

TEST(BlockStructure, HoldsTheMatrixAndTheLoad) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const StrengthSet set(packing);
    const BlockStructure& s = set.structure;
    ASSERT_EQ(s.rows(), static_cast<int>(set.rows.size()));
    ASSERT_EQ(s.columns(), set.problem.unknowns());
    Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(s.rows(), s.columns());
    for (const BlockStructure::Group& group : s.groups()) {
      for (int t = group.first_touch; t < group.end_touch; ++t) {
        const BlockStructure::Touch& touch = s.touches()[static_cast<std::size_t>(t)];
        EXPECT_EQ(touch.first_row, s.first_row(touch.node));
        EXPECT_EQ(touch.rows, s.node_rows(touch.node));
        for (int e = 0; e < group.columns; ++e) {
          for (int r = 0; r < touch.rows; ++r)
            blocks(touch.first_row + r, group.first_column + e) +=
                s.coefficients()[static_cast<std::size_t>(touch.coefficients + e * touch.rows + r)];
        }
      }
    }
    EXPECT_EQ(blocks, set.matrix());
    std::vector<int> equations = s.equation_of_place();
    for (std::size_t place = 0; place < equations.size(); ++place) {
      EXPECT_EQ(s.place_of_equation()[static_cast<std::size_t>(equations[place])], static_cast<int>(place));
      EXPECT_EQ(s.load()[place], set.problem.load()[equations[place]]);
    }
    std::sort(equations.begin(), equations.end());
    EXPECT_EQ(equations, set.rows);
    EXPECT_EQ(std::count(s.place_of_equation().begin(), s.place_of_equation().end(), -1),
              set.problem.equations() - s.rows());
  }
}

/// Walls and the cell, which touch many disks, border the factor.
TEST(BlockStructure, EliminatesWallsAndTheCellLast) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const StrengthSet set(packing);
    bool is_over = false;
    for (const int equation : set.structure.equation_of_place()) {
      const EquilibriumRow& row = set.problem.rows[static_cast<std::size_t>(equation)];
      const bool is_border = row.bound < 0 && (row.body.is_wall() || row.body.is_cell());
      EXPECT_TRUE(is_border || !is_over);
      is_over = is_border;
    }
  }
}

/// The rows of a contact's bounds touch its two disks, which share a block already: they cost their own
/// blocks, and none between others.
TEST(BlockStructure, BoundsOfForcesWidenNothing) {
  const Packing free = zoo::random_pile(101, 40, 0.5);
  Packing bounded = free;
  for (Contact& contact : bounded.contacts) {
    contact.R_lo = 1e-3;
    contact.R_hi = 1e3;
    contact.T_hi = 100;
  }
  const auto blocks_of_disks = [](const BlockStructure& s, const EquilibriumProblem& problem) {
    const auto is_bound = [&](int node) {
      const int row = s.equation_of_place()[static_cast<std::size_t>(s.first_row(node))];
      return problem.rows[static_cast<std::size_t>(row)].bound >= 0;
    };
    int count = 0;
    for (int node = 0; node < s.nodes(); ++node) {
      for (int block = s.first_block(node); block < s.first_block(node + 1); ++block) {
        if (!is_bound(node) && !is_bound(s.block_node(block))) ++count;
        if (is_bound(node)) {
          EXPECT_LE(s.first_block(node + 1) - s.first_block(node), 3);
        }
      }
    }
    return count;
  };
  const StrengthSet without(free), with(bounded);
  EXPECT_EQ(with.structure.rows(), without.structure.rows() + 3 * bounded.contact_count());
  // The order of the disks among themselves may differ a little.
  EXPECT_LT(blocks_of_disks(with.structure, with.problem),
            1.2 * blocks_of_disks(without.structure, without.problem));
}

TEST(BlockStructure, OfNothingIsEmpty) {
  Packing nothing;
  nothing.named_force_unit = 1;
  const StrengthSet set(nothing);
  EXPECT_EQ(set.structure.rows(), 0);
  EXPECT_EQ(set.structure.columns(), 0);
  EXPECT_EQ(set.structure.nodes(), 0);
}

TEST(BlockCholesky, ProductsAreThoseOfTheDenseMatrix) {
  Random random(21);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const StrengthSet set(packing);
    const Eigen::MatrixXd A = set.matrix();
    std::vector<double> x, y;
    for (int k = 0; k < set.structure.columns(); ++k) x.push_back(random.normal());
    for (int i = 0; i < set.structure.rows(); ++i) y.push_back(random.normal());
    EXPECT_LE((vector(product(set.structure, x)) - A * vector(x)).norm(),
              1e-14 * A.norm() * vector(x).norm());
    EXPECT_LE((vector(transposed_product(set.structure, y)) - A.transpose() * vector(y)).norm(),
              1e-14 * A.norm() * vector(y).norm());
  }
}

/// L Lᵀ = A D Aᵀ, and (L Lᵀ)⁻¹ as by another factorisation.
TEST(BlockCholesky, MultipliesBackAndSolves) {
  Random random(22);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const Eigen::MatrixXd A = set.matrix();
    for (const double decades : {0.0, 1.0, 3.0}) {
      const std::vector<double> D = random_weights(set.structure.columns(), decades, random);
      ASSERT_TRUE(set.cholesky.factor(D));
      const Eigen::MatrixXd M = A * vector(D).asDiagonal() * A.transpose();
      const Eigen::MatrixXd L = factor_of(set.structure, set.cholesky);
      // Entry by entry, relative to the diagonal: that is what rounding in Cholesky's method is.
      const Eigen::VectorXd root = M.diagonal().cwiseSqrt();
      EXPECT_LE(((L * L.transpose() - M).array() / (root * root.transpose()).array()).abs().maxCoeff(),
                1e-13);
      EXPECT_LE((vector(set.cholesky.inverse_diagonal()).array() * L.diagonal().array() - 1).abs().maxCoeff(),
                1e-15);

      std::vector<double> y;
      for (int i = 0; i < set.structure.rows(); ++i) y.push_back(random.normal());
      const Eigen::VectorXd right = vector(y);
      set.cholesky.solve(y);
      const Eigen::VectorXd scaled = root.asDiagonal() * vector(y);
      const Eigen::VectorXd expected = root.asDiagonal() * M.ldlt().solve(right);
      const Eigen::MatrixXd unit = root.cwiseInverse().asDiagonal() * M * root.cwiseInverse().asDiagonal();
      const double condition = 1 / Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(unit).eigenvalues()[0];
      EXPECT_LE((scaled - expected).norm(), 1e-13 * condition * expected.norm());
    }
  }
}

TEST(BlockCholesky, ScalesRowsAndShifts) {
  Random random(23);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const std::vector<double> D = random_weights(set.structure.columns(), 1, random);
    const std::vector<double> S = random_weights(set.structure.rows(), 2, random);
    const Eigen::MatrixXd SA = vector(S).asDiagonal() * set.matrix();
    const Eigen::MatrixXd M = SA * vector(D).asDiagonal() * SA.transpose();
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues()[0];
    const Eigen::VectorXd root = M.diagonal().cwiseSqrt();
    for (const double share : {0.0, 0.5, -3.0}) {
      ASSERT_TRUE(set.cholesky.factor(D, S, share * least));
      const Eigen::MatrixXd L = factor_of(set.structure, set.cholesky);
      const Eigen::MatrixXd shifted = M - share * least * Eigen::MatrixXd::Identity(M.rows(), M.cols());
      EXPECT_LE(((L * L.transpose() - shifted).array() / (root * root.transpose()).array()).abs().maxCoeff(),
                1e-13);
    }
  }
}

/// Sylvester: A D Aᵀ − shift · 1 is definite up to the smallest eigenvalue, and not beyond.
TEST(BlockCholesky, TellsWhetherTheShiftedMatrixIsDefinite) {
  Random random(24);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const std::vector<double> D = random_weights(set.structure.columns(), 0.5, random);
    const Eigen::MatrixXd A = set.matrix();
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A * vector(D).asDiagonal() * A.transpose())
            .eigenvalues();
    const std::vector<double> one(static_cast<std::size_t>(set.structure.rows()), 1.0);
    for (const double share : {-1.0, 0.0, 0.9, 0.999999})
      EXPECT_TRUE(set.cholesky.factor(D, one, share * eigenvalues[0])) << share;
    for (const double share : {1.000001, 1.1, 2.0})
      EXPECT_FALSE(set.cholesky.factor(D, one, share * eigenvalues[0])) << share;
    EXPECT_FALSE(set.cholesky.factor(D, one, 1.1 * eigenvalues[eigenvalues.size() - 1]));
    for (Eigen::Index k = 1; k < eigenvalues.size(); ++k)
      EXPECT_FALSE(set.cholesky.factor(D, one, (eigenvalues[k - 1] + eigenvalues[k]) / 2 * (1 + 1e-9)));
  }
}

/// A shift at which a pivot in the middle vanishes but for rounding lies beyond the smallest eigenvalue. The
/// pivot is then made huge, which hides its row from the pivots after it, so the sign of these tells nothing.
TEST(BlockCholesky, IsNotTakenInByAPivotThatVanishes) {
  Random random(25);
  int tried = 0;
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const int n = set.structure.rows();
    const std::vector<double> D = random_weights(set.structure.columns(), 0.5, random);
    const Eigen::MatrixXd A = set.matrix();
    const Eigen::MatrixXd M = A * vector(D).asDiagonal() * A.transpose();
    const std::vector<double> one(static_cast<std::size_t>(n), 1.0);
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues()[0];
    for (int leading = 2; leading < n; ++leading) {
      const double vanishing =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M.topLeftCorner(leading, leading)).eigenvalues()[0];
      if (vanishing < least * (1 + 1e-9)) continue;
      ++tried;
      for (int step = -100; step <= 100; ++step) {
        const double shift = vanishing * (1 + step * std::numeric_limits<double>::epsilon() / 2);
        EXPECT_FALSE(set.cholesky.factor(D, one, shift)) << leading << " rows, " << step;
      }
    }
  }
  EXPECT_GT(tried, 30);
}

/// A row that is another's multiple has no pivot: it is left out, and the others are solved as without it.
TEST(BlockCholesky, LeavesOutARowThatDependsOnOthers) {
  const Packing packing = zoo::periodic_lattice(3, 2, 0.3, 0.02);  // forces of a cell: two rows follow
  const EquilibriumProblem problem = pose_equilibrium(packing);
  const std::vector<int> independent = test::independent_rows(problem);
  ASSERT_EQ(static_cast<int>(independent.size()), problem.equations() - 2);
  std::vector<int> all(static_cast<std::size_t>(problem.equations()));
  std::iota(all.begin(), all.end(), 0);
  const BlockStructure structure(problem, all);
  BlockCholesky cholesky(structure);
  const std::vector<double> D(static_cast<std::size_t>(structure.columns()), 1.0);
  cholesky.factor(D);
  // Of a right-hand side in the range, some solution of A D Aᵀ w = b.
  std::vector<double> x;
  for (int k = 0; k < structure.columns(); ++k) x.push_back(1 + 0.3 * std::sin(k));
  const std::vector<double> b = product(structure, x);
  std::vector<double> w = b;
  cholesky.solve(w);
  std::vector<double> back = product(structure, transposed_product(structure, w));
  EXPECT_LE((vector(back) - vector(b)).norm(), 1e-10 * vector(b).norm());
}

}  // namespace
}  // namespace indet::barrier
