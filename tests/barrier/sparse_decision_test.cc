#include "libindet/polytope/sparse_decision.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <optional>

#include "tests/support/compare.h"
#include "tests/support/extremes.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

using Proof = SparseDecision::Proof;

/// The motion of the rows, spread over the disks.
Eigen::MatrixXd of_disks(const SparseDecision& decision) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(decision.problem.disks, 3);
  for (Eigen::Index i = 0; i < decision.motion.size(); ++i) {
    const EquilibriumRow& row = decision.problem.rows[static_cast<std::size_t>(i)];
    motion(row.body.disk_id().value(), row.component) = decision.motion[i];
  }
  return motion;
}

/// Whatever it says holds, in the internal unit.
void expect_consistent(const SparseDecision& decision) {
  if (!decision.decided) return;
  const EquilibriumProblem& problem = decision.problem;
  const Eigen::SparseMatrix<double>& A = problem.edge_matrix;
  const Eigen::VectorXd b = problem.load();
  if (decision.status == PolytopeStatus::kEmpty) {
    EXPECT_EQ(decision.dim, -1);
    EXPECT_LT(decision.motion.dot(b), 0);
    if (A.cols() > 0) {
      EXPECT_GE((A.transpose() * decision.motion).minCoeff(), -1e-13);
    }
    return;
  }
  const Eigen::VectorXd& x = decision.interior;
  ASSERT_EQ(x.size(), problem.unknowns());
  if (x.size() == 0) return;
  EXPECT_GT(x.minCoeff(), 0);
  EXPECT_LE((A * x - b).lpNorm<Eigen::Infinity>(), 1e-12 * std::max(1.0, x.maxCoeff()));
  if (decision.status == PolytopeStatus::kBounded) {
    EXPECT_GE((A.transpose() * decision.bounding).minCoeff(), 1 - 1e-9);
  }
  if (decision.status == PolytopeStatus::kUnbounded) {
    EXPECT_GE(decision.ray.minCoeff(), 0);
    EXPECT_NEAR(decision.ray.sum(), 1, 1e-12);
    EXPECT_LE((A * decision.ray).lpNorm<Eigen::Infinity>(), 1e-14);
  }
  for (const SparseDecision::Step& step : decision.steps) {
    EXPECT_FALSE(step.half_planes.empty());
    EXPECT_NEAR(step.motion.lpNorm<Eigen::Infinity>(), 1, 1e-12);
  }
}

/// … and in the equations of the scene, set up by other code.
void expect_consistent(const Packing& packing, const SparseDecision& decision) {
  expect_consistent(decision);
  if (!decision.decided) return;
  if (decision.status == PolytopeStatus::kEmpty && decision.steps.empty()) {
    EXPECT_TRUE(test::is_falling_motion(packing, of_disks(decision), 1e-12));
  }
  if (decision.status == PolytopeStatus::kUnbounded) {
    EXPECT_TRUE(test::is_recession_ray(packing, decision.problem.state(decision.ray).value(), 1e-12));
  }
}

void expect_same(const SparseDecision& decision, const ForcePolytope& polytope) {
  ASSERT_TRUE(decision.decided);
  EXPECT_STREQ(to_string(decision.status), to_string(polytope.status));
  EXPECT_EQ(decision.dim, polytope.dim);
  if (polytope.status == PolytopeStatus::kEmpty) return;
  // The same edges are open.
  ASSERT_EQ(decision.problem.unknowns(), polytope.problem.unknowns());
  EXPECT_TRUE(decision.problem.modes == polytope.problem.modes);
}

TEST(SparseDecision, AgreesWithLinearProgramsForAllScenes) {
  for (const Packing& packing : {zoo::wedge(0.4, 0.3),
                                 zoo::wedge(1.4, 0.3),
                                 zoo::wedge(0, 0.3),
                                 zoo::wedge(0.4, 0),
                                 zoo::disk_on_floor(0.3),
                                 zoo::disk_on_floor(0),
                                 zoo::disk_on_incline(0.1, 1),
                                 zoo::pyramid(0.8, 0.1, 1),
                                 zoo::pyramid(0.8, 1, 0.1),
                                 zoo::pyramid(0.8, 1, 1),
                                 zoo::column(9, 0.4, 0.3),
                                 zoo::frictionless_column(5, 0.4),
                                 zoo::column_between_walls(6, 0.3),
                                 zoo::pinched_disk(0.3),
                                 zoo::two_wedges(0.4, 0.3, 1.4, 0.3),
                                 zoo::corner(0.4, 1),
                                 zoo::corner(0.4, 0.9),
                                 zoo::corner(1, 1),
                                 zoo::spun_wedge(0.2, 0.1, 0.05),
                                 zoo::spun_wedge(0.2, 0.1, 0.2),
                                 zoo::wedge_and_corner(0.4, 0.3),
                                 zoo::wedge_and_loose_disk(0.4, 0.3, 0),
                                 zoo::wedge_and_loose_disk(0.4, 0.3, 1),
                                 zoo::lattice_pile(5, 0.6),
                                 zoo::lattice_pile(5, 0.3)}) {
    const SparseDecision decision = decide_sparsely(packing);
    expect_consistent(packing, decision);
    expect_same(decision, find_force_polytope(packing));
    EXPECT_NE(decision.proof, Proof::kNone);
  }
}

TEST(SparseDecision, AgreesWithLinearProgramsForPiles) {
  int empty = 0, unbounded = 0, closed = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const Packing packing = zoo::random_pile(seed, 3 + static_cast<int>(seed % 20), seed % 2 == 0 ? -1 : 0.4);
    const SparseDecision decision = decide_sparsely(packing);
    expect_consistent(packing, decision);
    expect_same(decision, find_force_polytope(packing));
    EXPECT_NE(decision.proof, Proof::kNone);
    empty += decision.status == PolytopeStatus::kEmpty;
    unbounded += decision.status == PolytopeStatus::kUnbounded;
    closed += !decision.steps.empty();
  }
  EXPECT_GT(empty, 5);
  EXPECT_GT(unbounded, 5);
  EXPECT_GE(closed, 1);
}

TEST(SparseDecision, IsRightOrUndecidedAtTheExtremes) {
  int scenes = 0, decided = 0;
  for (const extremes::Scene& scene : extremes::fixed_scenes()) {
    SCOPED_TRACE(scene.kind + ", " + scene.name);
    const SparseDecision decision = decide_sparsely(scene.packing);
    expect_consistent(decision);
    const ForcePolytope polytope = find_force_polytope(scene.packing);
    ++scenes;
    if (!decision.decided || polytope.doubtful) continue;
    ++decided;
    EXPECT_STREQ(to_string(decision.status), to_string(polytope.status));
    EXPECT_EQ(decision.dim, polytope.dim);
  }
  EXPECT_GT(decided, scenes * 3 / 5);
}

/// Decides it as it is, and without one of its contacts.
void expect_decided(Packing packing, std::optional<PolytopeStatus> status) {
  SparseDecision decision = decide_sparsely(packing);
  expect_consistent(packing, decision);
  EXPECT_TRUE(decision.decided);
  EXPECT_STREQ(to_string(decision.status), to_string(status.value_or(decision.status)));
  packing.contacts.erase(packing.contacts.begin() + packing.contact_count() / 4);
  decision = decide_sparsely(packing);
  EXPECT_TRUE(decision.decided);
  expect_consistent(packing, decision);
}

TEST(SparseDecision, DecidesLargePiles) {
  // 325 disks on a lattice, degenerate.
  for (const double mu : {0.0, 0.3, 0.5}) expect_decided(zoo::lattice_pile(25, mu), PolytopeStatus::kEmpty);
  for (const double mu : {0.6, 1.5}) expect_decided(zoo::lattice_pile(25, mu), PolytopeStatus::kBounded);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    expect_decided(zoo::random_pile(seed, 60, 0.3), {});
    expect_decided(zoo::random_pile(seed, 60, 1.5), PolytopeStatus::kUnbounded);
  }
}

TEST(SparseDecision, DecidesLargeColumns) {
  const Packing jammed = zoo::column_between_walls(150, 0.3);
  const SparseDecision between = decide_sparsely(jammed);
  ASSERT_TRUE(between.decided);
  EXPECT_EQ(between.status, PolytopeStatus::kUnbounded);
  expect_consistent(jammed, between);

  const Packing smooth = zoo::frictionless_column(200, 0.4);
  const SparseDecision point = decide_sparsely(smooth);
  ASSERT_TRUE(point.decided);
  EXPECT_EQ(point.status, PolytopeStatus::kPoint);
  EXPECT_EQ(point.dim, 0);
  expect_consistent(smooth, point);
}

}  // namespace
}  // namespace indet
