#include "libindet/pivoting/tableau.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "libindet/base/random.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

Basis first_vertex(const SlopeView& view, Random& random) {
  Eigen::VectorXd guide(view.dim());
  for (double& value : guide) value = random.normal();
  return purify_to_vertex(view, Eigen::VectorXd::Zero(view.dim()), guide);
}

/// Every entry against its definition.
void expect_right(const SlopeView& view, const Tableau& tableau, double tolerance) {
  ASSERT_TRUE(tableau.is_built());
  const Eigen::MatrixXd active = view.slope(tableau.active(), Eigen::all);
  const Eigen::MatrixXd slack = view.slope(tableau.slack(), Eigen::all);
  const Eigen::MatrixXd rates = slack * active.inverse();
  EXPECT_LT((tableau.rates() - rates).cwiseAbs().maxCoeff(), tolerance);
  const Vertex vertex = compute_vertex(view, tableau.basis());
  EXPECT_LT((tableau.slacks() - vertex.x(tableau.slack())).cwiseAbs().maxCoeff(), tolerance);
  for (int j = 0; j < view.dim(); ++j) {
    EXPECT_EQ(tableau.column_of(tableau.active()[static_cast<std::size_t>(j)]), j);
    EXPECT_EQ(tableau.row_of(tableau.active()[static_cast<std::size_t>(j)]), -1);
    if (tableau.weights().size() > 0) {
      EXPECT_NEAR(tableau.weights()[j] / (1 + rates.col(j).squaredNorm()), 1, tolerance);
    }
  }
}

TEST(Tableau, FollowsPivotsFromVertexToVertex) {
  Random random(51);
  for (const bool with_weights : {false, true}) {
    const SlopeView view = test::random_polytope(7, 20, false, random);
    Tableau tableau(view, with_weights);
    ASSERT_TRUE(tableau.build(first_vertex(view, random)));
    expect_right(view, tableau, 1e-12);
    for (int step = 0; step < 30; ++step) {
      const int column = static_cast<int>(random.below(7));
      Eigen::Index row = 0;
      tableau.rates().col(column).cwiseAbs().maxCoeff(&row);
      const int entering = tableau.slack()[static_cast<std::size_t>(row)];
      const int leaving = tableau.active()[static_cast<std::size_t>(column)];
      tableau.pivot(static_cast<int>(row), column);
      EXPECT_EQ(tableau.column_of(entering), column);
      EXPECT_EQ(tableau.row_of(leaving), static_cast<int>(row));
      expect_right(view, tableau, 1e-9);
      EXPECT_LT(tableau.error(), 1e-10);
    }
  }
}

TEST(Tableau, GoesToAnyVertexAtOnce) {
  Random random(52);
  const SlopeView view = test::random_polytope(8, 24, false, random);
  Tableau tableau(view, true);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Basis there = first_vertex(view, random);
    ASSERT_TRUE(tableau.move_to(there));
    EXPECT_EQ(tableau.basis(), there);
    expect_right(view, tableau, 1e-9);
  }
}

TEST(Tableau, RefusesDependentInequalities) {
  SlopeView view;
  view.slope.resize(4, 2);
  view.slope << 1, 0, -1, 0, 0, 1, 0, -1;
  view.offset = Eigen::Vector4d::Ones();
  Tableau tableau(view, false);
  EXPECT_FALSE(tableau.build({0, 1}));
  EXPECT_FALSE(tableau.is_built());
  EXPECT_TRUE(tableau.build({0, 2}));
  EXPECT_FALSE(tableau.move_to({0, 1}));
}

TEST(Tableau, GradientIsTheChangeOfTheObjectiveAlongEdges) {
  Random random(53);
  const SlopeView view = test::random_polytope(5, 9, false, random);
  Tableau tableau(view, false);
  ASSERT_TRUE(tableau.build(first_vertex(view, random)));
  const int active = tableau.active()[2];
  const int slack = tableau.slack()[3];
  const Objective objective = make_objective(view, {{active, 2.0}, {slack, -0.5}});
  const Eigen::VectorXd gradient = tableau.gradient(objective);
  const Vertex vertex = compute_vertex(view, tableau.basis());
  for (int j = 0; j < view.dim(); ++j) {
    const auto place =
        std::find(vertex.basis.begin(), vertex.basis.end(), tableau.active()[static_cast<std::size_t>(j)]);
    const Eigen::VectorXd edge = vertex.edge_direction(static_cast<int>(place - vertex.basis.begin()));
    EXPECT_NEAR(gradient[j], objective.along_z.dot(edge), 1e-11);
  }
}

}  // namespace
}  // namespace indet
