#include "libindet/pivoting/tableau_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "libindet/base/random.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "tests/support/maximiser_checks.h"
#include "tests/support/objectives.h"
#include "tests/support/oracle.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

using test::best_corner;
using test::random_objective;
using test::value_of;

test::MakeMaximiser maker(PivotRule rule) {
  return [rule](const SlopeView& view) { return std::make_unique<TableauSolver>(view, rule); };
}

class Rules : public testing::TestWithParam<PivotRule> {};

TEST_P(Rules, FindTheBestCorner) {
  Random random(61);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(5));
    const SlopeView view =
        test::random_polytope(d, static_cast<int>(random.below(7)), repeat % 2 == 1, random);
    const oracle::Corners corners = oracle::enumerate_corners(view.slope, view.offset);
    TableauSolver solver(view, GetParam());
    const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    for (int goal = 0; goal < 5; ++goal) {
      SCOPED_TRACE(std::to_string(repeat) + ", " + std::to_string(goal));
      const Objective objective = random_objective(view, random);
      const LpAnswer answer = solver.maximise(objective, start);
      ASSERT_EQ(answer.status, LpStatus::kOptimal);
      EXPECT_NEAR(value_of(view, objective, answer), best_corner(view, corners, objective, {}), 1e-9);
      EXPECT_TRUE(std::is_sorted(answer.basis.begin(), answer.basis.end()));
      EXPECT_EQ(solver.maximise(objective, answer.basis).pivots, 0) << "an optimal start needs no pivot";
    }
  }
}

TEST_P(Rules, KeepHeldFaces) {
  Random random(62);
  test::expect_held_faces_are_kept_and_released(maker(GetParam()), random);
}

TEST_P(Rules, TellUnboundedFromOptimal) {
  test::expect_unbounded_is_told_from_optimal(maker(GetParam()), {{0, 1}});
}

/// Beale's problem, on which Dantzig's rule with exact ties goes round for ever: maximise
/// 3/4 a − 150 b + 1/50 c − 6 d over a, b, c, d ≥ 0 and the three inequalities below; 1/20 at (1/25, 0, 1,
/// 0).
TEST_P(Rules, DoNotCycle) {
  SlopeView view;
  view.slope = Eigen::MatrixXd::Identity(7, 4);
  view.slope.row(4) << -0.25, 60, 1.0 / 25, -9;
  view.slope.row(5) << -0.5, 90, 1.0 / 50, -3;
  view.slope.row(6) << 0, 0, -1, 0;
  view.offset = Eigen::VectorXd::Unit(7, 6);
  TableauSolver solver(view, GetParam());
  const Objective objective = make_objective(view, {{0, 0.75}, {1, -150}, {2, 1.0 / 50}, {3, -6}});
  const LpAnswer answer = solver.maximise(objective, {0, 1, 2, 3});
  ASSERT_EQ(answer.status, LpStatus::kOptimal);
  EXPECT_NEAR(value_of(view, objective, answer), 0.05, 1e-15);
}

TEST_P(Rules, GiveUpAtTheirLimit) {
  Random random(63);
  const SlopeView view = test::random_polytope(6, 20, false, random);
  LpOptions options;
  options.iteration_limit = 1;
  const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(6), -Eigen::VectorXd::Ones(6));
  const Objective objective =
      make_objective(view, {{0, 1.0}, {1, 1.0}, {2, 1.0}, {3, 1.0}, {4, 1.0}, {5, 1.0}});
  const LpAnswer answer = TableauSolver(view, GetParam(), options).maximise(objective, start);
  EXPECT_EQ(answer.status, LpStatus::kFailed);
  EXPECT_TRUE(answer.basis.empty());
}

INSTANTIATE_TEST_SUITE_P(Pivoting, Rules,
                         testing::Values(PivotRule::kDantzig, PivotRule::kSteepestEdge,
                                         PivotRule::kBestNeighbour),
                         [](const auto& tested) {
                           std::string name = to_string(tested.param);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace indet
