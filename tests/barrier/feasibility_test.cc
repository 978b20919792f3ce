#include "libindet/barrier/feasibility.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "libindet/barrier/verified_motion.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "tests/support/zoo.h"

namespace indet::barrier {
namespace {

/// A problem with independent rows.
struct Solved {
  explicit Solved(const Packing& packing)
      : problem(pose_equilibrium(packing)), rows(static_cast<std::size_t>(problem.equations())) {
    std::iota(rows.begin(), rows.end(), 0);
    structure = std::make_unique<BlockStructure>(problem, rows);
    BlockCholesky cholesky(*structure);
    feasibility = find_feasibility(*structure, cholesky);
    boundedness = find_boundedness(*structure, cholesky);
  }
  Eigen::VectorXd on_equations(const std::vector<double>& y) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(problem.equations());
    for (std::size_t i = 0; i < y.size(); ++i) result[structure->equation_of_place()[i]] = y[i];
    return result;
  }
  EquilibriumProblem problem;
  std::vector<int> rows;
  std::unique_ptr<BlockStructure> structure;
  Feasibility feasibility;
  Boundedness boundedness;
};

Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(Feasibility, FindsAnInteriorAndWhatBoundsIt) {
  const Solved groove(zoo::wedge(0.4, 0.3));
  ASSERT_EQ(groove.feasibility.kind, Feasibility::Kind::kInterior);
  const Eigen::VectorXd x = as_vector(groove.feasibility.x);
  EXPECT_GT(x.minCoeff(), 1e-3);
  EXPECT_LE((groove.problem.edge_matrix * x - groove.problem.load()).norm(), 1e-14);
  ASSERT_TRUE(groove.boundedness.decided && groove.boundedness.bounded);
  const Eigen::VectorXd y = groove.on_equations(groove.boundedness.y);
  EXPECT_GE((groove.problem.edge_matrix.transpose() * y).minCoeff(), 1 - 1e-14);
  EXPECT_FALSE(proves_emptiness(groove.problem, *groove.structure, groove.boundedness.y));
}

TEST(Feasibility, FindsTheRayOfASteepGroove) {
  const Solved groove(zoo::wedge(1.4, 0.3));
  EXPECT_EQ(groove.feasibility.kind, Feasibility::Kind::kInterior);
  ASSERT_TRUE(groove.boundedness.decided);
  EXPECT_FALSE(groove.boundedness.bounded);
  const Eigen::VectorXd ray = as_vector(groove.boundedness.ray);
  EXPECT_NEAR(ray.sum(), 1, 1e-14);
  EXPECT_GE(ray.minCoeff(), 0);
  EXPECT_LE((groove.problem.edge_matrix * ray).norm(), 1e-15);
}

TEST(Feasibility, ClosesTheContactOfACorner) {
  // The wall transmits nothing: edges 2 and 3. The floor holds the disk by its normal force alone.
  const Solved corner(zoo::corner(0.4, 0.9));
  ASSERT_EQ(corner.feasibility.kind, Feasibility::Kind::kClosed);
  EXPECT_EQ(corner.feasibility.closed, (std::vector<int>{2, 3}));
  EXPECT_GT(corner.feasibility.margin, 1e6);
  const Eigen::VectorXd x = as_vector(corner.feasibility.x);
  EXPECT_EQ(x[2], 0);
  EXPECT_LE((corner.problem.edge_matrix * x - corner.problem.load()).norm(), 1e-14);
  const Eigen::VectorXd y = corner.on_equations(corner.feasibility.y);
  const Eigen::VectorXd power = corner.problem.edge_matrix.transpose() * y;
  EXPECT_NEAR(power[0], 0, 1e-15);
  EXPECT_NEAR(power[1], 0, 1e-15);
  EXPECT_GT(power[2], 1e-3);
  EXPECT_GT(power[3], 1e-3);
  EXPECT_NEAR(y.dot(corner.problem.load()), 0, 1e-15);
}

TEST(Feasibility, FindsAMotionOfWhatCannotStandAndProvesIt) {
  const Solved pyramid(zoo::pyramid(0.8, 1, 0.1));
  ASSERT_EQ(pyramid.feasibility.kind, Feasibility::Kind::kEmpty);
  const Eigen::VectorXd y = pyramid.on_equations(pyramid.feasibility.y);
  EXPECT_NEAR(y.lpNorm<Eigen::Infinity>(), 1, 1e-15);
  EXPECT_GE((pyramid.problem.edge_matrix.transpose() * y).minCoeff(), -1e-15);
  EXPECT_LT(y.dot(pyramid.problem.load()), -1e-3);
  // Some contact rests under the motion; moved a little it is a proof.
  ASSERT_TRUE(pyramid.boundedness.bounded);
  const auto proven =
      proven_motion(pyramid.problem, *pyramid.structure, pyramid.feasibility.y, pyramid.boundedness.y);
  ASSERT_TRUE(proven);
  EXPECT_TRUE(proves_emptiness(pyramid.problem, *pyramid.structure, *proven));
  std::vector<double> back = pyramid.feasibility.y;
  for (double& velocity : back) velocity = -velocity;
  EXPECT_FALSE(proven_motion(pyramid.problem, *pyramid.structure, back, pyramid.boundedness.y));
}

TEST(Feasibility, LeavesAHairlineUndecidedOrIsRight) {
  for (const double share : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12}) {
    for (const double sign : {-1.0, 1.0}) {
      const double torque = (1 + sign * share) * zoo::spun_wedge_critical_torque(0.6, 0.3);
      const Feasibility::Kind kind = Solved(zoo::spun_wedge(0.6, 0.3, torque)).feasibility.kind;
      if (kind == Feasibility::Kind::kUndecided) continue;
      EXPECT_EQ(kind, sign > 0 ? Feasibility::Kind::kEmpty : Feasibility::Kind::kInterior) << sign * share;
    }
  }
}

}  // namespace
}  // namespace indet::barrier
