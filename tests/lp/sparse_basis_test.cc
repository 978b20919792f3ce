#include "libindet/lp/sparse_basis.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

/// Another route to S_N⁻¹ than the dense factor of a Vertex.
TEST(SparseBasis, AgreesWithTheDenseFactor) {
  Random random(11);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(8));
    const SlopeView view = test::random_polytope(d, 9, repeat % 2 == 1, random);
    const Vertex vertex =
        compute_vertex(view, purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d)));
    const auto sparse = SparseBasis::factorise(view.set, vertex.basis);
    ASSERT_TRUE(sparse);
    EXPECT_LE((sparse->point() - vertex.x).norm(), 1e-11);
    for (int k = 0; k < d; ++k) EXPECT_LE((sparse->edge(k) - vertex.edge_rates(view, k)).norm(), 1e-10);
    const int active = vertex.basis.back();
    for (const auto& on_edges : {std::vector<std::pair<int, double>>{{0, 2.0}, {d, -1.0}},
                                 std::vector<std::pair<int, double>>{{active, -0.5}}}) {
      EXPECT_LE((sparse->multipliers(on_edges) - vertex.multipliers(make_objective(view, on_edges))).norm(),
                1e-10);
    }
  }
}

TEST(SparseBasis, KnowsInequalitiesThatDependOnEachOther) {
  SlopeView view;  // 0 ≤ z0 ≤ 1, 0 ≤ z1 ≤ 1
  view.slope.resize(4, 2);
  view.slope << 1, 0, -1, 0, 0, 1, 0, -1;
  view.offset = Eigen::Vector4d(0, 1, 0, 1);
  test::make_set(view);
  EXPECT_FALSE(SparseBasis::factorise(view.set, {0, 1}));
  EXPECT_TRUE(SparseBasis::factorise(view.set, {0, 2}));
}

/// Beyond the dimension from which vertices are located by sparse factors.
TEST(SparseBasis, StandsForTheVertexOfALargeSet) {
  Random random(12);
  const int d = 200;
  const SlopeView view = test::random_polytope(d, 20, false, random);
  const Basis basis = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
  const Vertex sparse = locate_vertex(view, basis);
  const Vertex dense = compute_vertex(view, basis);
  EXPECT_TRUE(sparse.sparse);
  EXPECT_FALSE(dense.sparse);
  EXPECT_LE((sparse.x - dense.x).norm(), 1e-9 * dense.x.norm());
  for (const int k : basis) EXPECT_EQ(sparse.x[k], 0);
  for (const int k : {0, d / 2, d - 1}) {
    const double length = polytope_edge_length(view, dense, k);
    EXPECT_NEAR(polytope_edge_length(view, sparse, k), length, 1e-8 * length);
  }
}

}  // namespace
}  // namespace indet
