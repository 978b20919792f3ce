#include "libindet/polytope/recession_cone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/polytope/interior.h"
#include "tests/support/compare.h"
#include "tests/support/sets.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// More disks than the dimension from which sparse equations are used.
constexpr int kDisks = 110;

TEST(RecessionCone, ItsEquationsAreThoseOfItsView) {
  Random random(64);
  for (int repeat = 0; repeat < 4; ++repeat) {
    SlopeView view = test::random_polytope(kFewestForEquations + static_cast<int>(random.below(5)), 6,
                                           repeat % 2 == 1, random);
    const SlopeView cone = truncated_recession_cone(view);
    ASSERT_TRUE(cone.set);
    EXPECT_EQ(cone.set->dim(), cone.dim());
    EXPECT_EQ(cone.set->inequalities(), cone.inequalities());
    EXPECT_LE((cone.set->equations * cone.slope).norm(), 1e-12);
    EXPECT_LE((cone.set->equations * cone.offset - cone.set->right_hand_side).norm(), 1e-13);
  }
}

/// Walls can press a straight row together, and nothing else can grow.
TEST(RecessionCone, OfARowIsItsCompression) {
  const Packing packing = zoo::row_between_walls(kDisks, 0.3);
  const ForcePolytope polytope = find_force_polytope(packing);
  ASSERT_EQ(polytope.status, PolytopeStatus::kUnbounded);
  ASSERT_EQ(polytope.blocks.size(), 1);
  const PolytopeBlock& block = polytope.blocks.front();
  ASSERT_TRUE(block.recession);
  const RecessionCone& cone = *block.recession;
  EXPECT_EQ(cone.truncated.dim(), 1);
  EXPECT_EQ(cone.edges.size(), 2 * (kDisks + 1));
  const Eigen::VectorXd point = cone.truncated.slope.col(0) / cone.truncated.slope(0, 0);
  const Eigen::VectorXd state = polytope.problem.state(cone.ray(point, block.view.inequalities())).value();
  EXPECT_TRUE(test::is_recession_ray(packing, state, 1e-12));
  // A functional keeps what is on edges of the cone, under their numbers there.
  const int last = cone.edges.back();
  using Terms = std::vector<std::pair<int, double>>;
  EXPECT_EQ(cone.restricted({{last, 2.0}}), (Terms{{2 * kDisks + 1, 2.0}}));
  for (int k = 0; k < block.view.inequalities(); ++k) {
    const bool is_loaded = std::binary_search(cone.edges.begin(), cone.edges.end(), k);
    EXPECT_EQ(cone.restricted({{k, 1.0}}).size(), is_loaded ? 1 : 0);
  }
}

TEST(RecessionCone, WithoutAGuessIsFoundByLinearPrograms) {
  const ForcePolytope polytope = find_force_polytope(zoo::row_between_walls(kDisks, 0.3));
  const PolytopeBlock& block = polytope.blocks.front();
  const auto found = find_recession_cone(block.view, Eigen::VectorXd::Zero(block.view.inequalities()), {});
  EXPECT_EQ(found->edges, block.recession->edges);
}

TEST(InteriorPoint, IsTheSameBySparseEquations) {
  const ForcePolytope polytope = find_force_polytope(zoo::row_between_walls(kDisks, 0.3));
  SlopeView view = polytope.blocks.front().view;
  ASSERT_EQ(choose_formulation_of_one(view), Formulation::kEdge);
  const InteriorPoint sparse = find_interior_point(view, {});
  view.set.reset();
  const InteriorPoint dense = find_interior_point(view, {});
  EXPECT_GT(sparse.slack, 0);
  EXPECT_NEAR(sparse.slack, dense.slack, 1e-12);
  EXPECT_NEAR((view.offset + view.slope * sparse.z).minCoeff(), sparse.slack, 1e-12);
}

}  // namespace
}  // namespace indet
