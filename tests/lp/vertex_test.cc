#include "libindet/lp/vertex.h"

#include <gtest/gtest.h>

#include <limits>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/lp/purification.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

TEST(Walk, EndsAtAFeasibleVertexAndNeverLosesTheGuide) {
  Random random(51);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(6));
    const SlopeView view =
        test::random_polytope(d, static_cast<int>(random.below(10)), repeat % 2 == 1, random);
    Eigen::VectorXd guide(d);
    for (double& g : guide) g = random.normal();
    const Eigen::VectorXd from = Eigen::VectorXd::Constant(d, 0.01);
    for (const Eigen::VectorXd& along : {guide, Eigen::VectorXd(Eigen::VectorXd::Zero(d))}) {
      const Basis basis = purify_to_vertex(view, from, along);
      ASSERT_EQ(static_cast<int>(basis.size()), d);
      EXPECT_TRUE(std::is_sorted(basis.begin(), basis.end()));
      const Vertex vertex = compute_vertex(view, basis);
      EXPECT_LE(vertex.infeasibility(), 1e-10) << repeat;
      EXPECT_GE(along.dot(vertex.z), along.dot(from) - 1e-10);
    }
  }
}

TEST(Walk, FindsTheVertexOfAnUnboundedSet) {
  SlopeView view;
  view.slope = Eigen::Matrix2d::Identity();
  view.offset = Eigen::Vector2d::Zero();
  EXPECT_EQ(purify_to_vertex(view, Eigen::Vector2d(2, 3), Eigen::Vector2d(1, 1)), (Basis{0, 1}));
}

TEST(Walk, RefusesASetWithALine) {
  SlopeView view;
  view.slope = Eigen::RowVector2d(1, 0);
  view.offset = Eigen::VectorXd::Zero(1);
  EXPECT_THROW(purify_to_vertex(view, Eigen::Vector2d(2, 3), Eigen::Vector2d(1, 1)), LibraryError);
}

TEST(Vertex, SatisfiesItsInequalitiesAndItsMultipliersReproduceTheObjective) {
  Random random(52);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(5));
    const SlopeView view = test::random_polytope(d, 6, repeat % 2 == 1, random);
    const Basis basis = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    const Vertex vertex = compute_vertex(view, basis);
    for (const int k : basis) {
      EXPECT_EQ(vertex.x[k], 0);
      EXPECT_NEAR(view.offset[k] + view.slope.row(k).dot(vertex.z), 0, 1e-13);
    }
    const Objective objective = make_objective(view, {{0, 2.0}, {d, -1.0}});
    EXPECT_LE((objective.along_z - 2 * view.slope.row(0).transpose() + view.slope.row(d).transpose()).norm(),
              1e-15);
    const Eigen::VectorXd costs = vertex.multipliers(objective);
    EXPECT_LE((view.slope(basis, Eigen::all).transpose() * costs + objective.along_z).norm(), 1e-12);
    for (int k = 0; k < d; ++k) {
      // Leaving inequality k by one unit loses its multiplier.
      EXPECT_NEAR(objective.along_z.dot(vertex.edge_direction(k)), -costs[k], 1e-12);
      const double length = polytope_edge_length(view, vertex, k);
      ASSERT_TRUE(std::isfinite(length));
      const Eigen::VectorXd end = view.offset + view.slope * (vertex.z + length * vertex.edge_direction(k));
      EXPECT_GE(end.minCoeff(), -1e-10);
      const Eigen::VectorXd beyond =
          view.offset + view.slope * (vertex.z + (length + 1e-3) * vertex.edge_direction(k));
      EXPECT_LT(beyond.minCoeff(), -1e-6);
    }
  }
}

TEST(Vertex, EdgeOfAnUnboundedSetHasNoEnd) {
  SlopeView view;
  view.slope = Eigen::Matrix2d::Identity();
  view.offset = Eigen::Vector2d::Zero();
  EXPECT_EQ(polytope_edge_length(view, compute_vertex(view, {0, 1}), 0),
            std::numeric_limits<double>::infinity());
}

TEST(Vertex, DependentRowsAreRefused) {
  SlopeView view;
  view.slope.resize(3, 2);
  view.slope << 1, 0, 2, 0, 0, 1;
  view.offset = Eigen::Vector3d(1, 1, 1);
  EXPECT_THROW(compute_vertex(view, {0, 1}), LibraryError);
  EXPECT_THROW(compute_vertex(view, {0}), LibraryError);
}

}  // namespace
}  // namespace indet
