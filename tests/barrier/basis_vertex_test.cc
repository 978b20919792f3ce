#include "libindet/barrier/basis_vertex.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "libindet/base/random.h"
#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

/// Columns of A, the first ones of which depend on each other more often than not.
TEST(BasisVertex, ReplacesColumnsThatDependOnOthers) {
  Random random(1);
  int dependent = 0;
  for (const auto& [name, packing] : test::packings()) {
    SCOPED_TRACE(name);
    const test::StrengthSet set(packing);
    const Eigen::MatrixXd A = set.matrix();
    if (A.rows() == 0) continue;
    for (int k = 0; k < 5; ++k) {
      std::vector<double> rank;
      for (Eigen::Index column = 0; column < A.cols(); ++column) rank.push_back(random.uniform());
      BasisVertex vertex(set.structure);
      if (!vertex.set_basis(rank)) continue;
      // The basis is regular, and its columns give the load.
      std::vector<int> basis, first;
      for (int column = 0; column < A.cols(); ++column) {
        if (vertex.is_basic(column)) basis.push_back(column);
        const auto better = [&](double other) { return other > rank[static_cast<std::size_t>(column)]; };
        if (std::count_if(rank.begin(), rank.end(), better) < A.rows()) first.push_back(column);
      }
      ASSERT_EQ(std::ssize(basis), A.rows());
      EXPECT_EQ(std::ssize(vertex.closed()), A.cols() - A.rows());
      EXPECT_TRUE(Eigen::FullPivLU<Eigen::MatrixXd>(A(Eigen::all, basis)).isInvertible());
      if (!Eigen::FullPivLU<Eigen::MatrixXd>(A(Eigen::all, first)).isInvertible()) ++dependent;
      const auto x = vertex.solution(set.structure.load());
      ASSERT_TRUE(x);
      const Eigen::VectorXd left = A * test::vector(*x) - test::vector(set.structure.load());
      EXPECT_LE(left.cwiseAbs().maxCoeff(), 1e-9 * (1 + test::vector(*x).cwiseAbs().maxCoeff()));
    }
  }
  EXPECT_GT(dependent, 3);
}

}  // namespace
}  // namespace indet::barrier
