#include "libindet/polytope/force_polytope.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "libindet/lp/vertex.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// What every polytope must satisfy, whatever the packing.
void expect_consistent(const Packing& packing, const ForcePolytope& polytope) {
  const Eigen::MatrixXd c = oracle::paper_matrix(packing);
  const Eigen::VectorXd w = oracle::paper_wrench(packing);
  if (polytope.status == PolytopeStatus::kEmpty) {
    EXPECT_EQ(polytope.dim, -1);
    EXPECT_TRUE(test::is_falling_motion(packing, polytope.motion, 1e-9));
    return;
  }
  EXPECT_GE(polytope.lightest.size() > 0 ? polytope.lightest.minCoeff() : 0, -1e-12);
  const Eigen::VectorXd state = polytope.problem.state(polytope.lightest).value();
  EXPECT_LE((c * state + w).lpNorm<Eigen::Infinity>(), 1e-11 * std::max(1.0, state.norm()));
  if (polytope.status == PolytopeStatus::kUnbounded) {
    EXPECT_TRUE(test::is_recession_ray(packing, polytope.problem.state(polytope.ray).value(), 1e-11));
  }
  int dim = 0;
  std::set<int> seen;
  for (const PolytopeBlock& block : polytope.blocks) {
    dim += block.view.dim();
    for (const int edge : block.edges) EXPECT_TRUE(seen.insert(edge).second) << "edge in two blocks";
    // Each block's motion balances by itself, its lightest vertex is that of the whole, and its two
    // descriptions agree.
    const Vertex vertex = compute_vertex(block.view, block.lightest);
    for (std::size_t k = 0; k < block.edges.size(); ++k)
      EXPECT_NEAR(vertex.x[static_cast<Eigen::Index>(k)], polytope.lightest[block.edges[k]], 1e-11);
    for (int j = 0; j < block.view.dim(); ++j) {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(polytope.problem.unknowns());
      x(block.edges) = block.view.slope.col(j);
      EXPECT_LE((c * polytope.problem.state(x).value()).norm(), 1e-11);
    }
    EXPECT_EQ(block.set().dim(), block.view.dim());
    EXPECT_EQ(block.set().inequalities(), block.view.inequalities());
    EXPECT_LE((block.set().equations * block.view.slope).norm(), 1e-12);
    EXPECT_LE((block.set().equations * block.view.offset - block.set().right_hand_side).norm(), 1e-13);
    EXPECT_EQ(oracle::solve_dense(Eigen::MatrixXd(block.set().equations),
                                  Eigen::VectorXd::Zero(block.set().equations.rows()))
                  .rank,
              block.set().equations.rows());
  }
  EXPECT_EQ(dim, polytope.dim);
}

TEST(ForcePolytope, IsConsistentForAllScenes) {
  for (const Packing& packing :
       {zoo::wedge(0.4, 0.3), zoo::wedge(1.4, 0.3), zoo::disk_on_floor(0.3), zoo::disk_on_incline(0.1, 1),
        zoo::pyramid(0.8, 0.1, 1), zoo::pyramid(0.8, 1, 0.1), zoo::pyramid(0.8, 1, 1),
        zoo::column(9, 0.4, 0.3), zoo::frictionless_column(5, 0.4), zoo::pinched_disk(0.3),
        zoo::two_wedges(0.4, 0.3, 1.4, 0.3), zoo::corner(0.4, 1), zoo::corner(0.4, 0.9),
        zoo::wedge_and_corner(0.4, 0.3), zoo::wedge_and_loose_disk(0.4, 0.3, 1), zoo::lattice_pile(5, 0.6),
        zoo::lattice_pile(5, 0.3)})
    expect_consistent(packing, find_force_polytope(packing));
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Packing packing = zoo::random_pile(seed, 3 + static_cast<int>(seed % 20), seed % 2 == 0 ? -1 : 0.4);
    expect_consistent(packing, find_force_polytope(packing));
  }
}

TEST(ForcePolytope, LightestStateIsThatOfAllVertices) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Packing packing = zoo::random_pile(seed, 4, 0.5);
    const oracle::States states = oracle::enumerate_states(packing);
    const ForcePolytope polytope = find_force_polytope(packing);
    ASSERT_EQ(polytope.dim, states.dim) << seed;
    if (states.dim < 0) continue;
    const auto total = [](const Eigen::VectorXd& state) {
      return state(Eigen::seq(0, Eigen::last, 2)).sum();
    };
    double least = 1e300;
    for (Eigen::Index i = 0; i < states.vertices.rows(); ++i)
      least = std::min(least, total(states.vertices.row(i).transpose()));
    EXPECT_NEAR(total(polytope.problem.state(polytope.lightest).value()), least, 1e-9) << seed;
  }
}

TEST(ForcePolytope, IndependentGroovesAreTwoBlocks) {
  const ForcePolytope polytope = find_force_polytope(zoo::two_wedges(0.4, 0.3, 0.5, 0.3));
  ASSERT_EQ(polytope.blocks.size(), 2U);
  EXPECT_EQ(polytope.blocks[0].edges, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(polytope.blocks[1].edges, (std::vector<int>{4, 5, 6, 7}));
}

TEST(ForcePolytope, ClosedContactsLoseTheirUnknowns) {
  const ForcePolytope polytope = find_force_polytope(zoo::wedge_and_corner(0.4, 0.3));
  EXPECT_EQ(polytope.natural_null_space->nullity, 2);
  EXPECT_EQ(polytope.dim, 1);
  EXPECT_EQ(polytope.problem.modes[3], ContactMode::kOpen);
  EXPECT_EQ(polytope.problem.modes[0], ContactMode::kStick);
  const ForcePolytope sliding = find_force_polytope(zoo::corner(0.4, 1));
  EXPECT_EQ(sliding.problem.modes[1], ContactMode::kSlidePlus);
  EXPECT_EQ(sliding.dim, 1);
}

}  // namespace
}  // namespace indet
