#include "libindet/lp/lp_solver.h"

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>

#include "libindet/base/random.h"
#include "libindet/lp/glpk_problem.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "tests/support/maximiser_checks.h"
#include "tests/support/objectives.h"
#include "tests/support/oracle.h"
#include "tests/support/sets.h"

namespace indet {

void PrintTo(Formulation formulation, std::ostream* stream) { *stream << to_string(formulation); }

namespace {

using test::best_corner;
using test::random_objective;
using test::value_of;

test::MakeMaximiser maker(Formulation formulation) {
  return [formulation](const SlopeView& view) { return std::make_unique<LpSolver>(view, formulation); };
}

class Formulations : public testing::TestWithParam<Formulation> {};

TEST_P(Formulations, FindTheBestCornerWarmAndCold) {
  Random random(41);
  for (int repeat = 0; repeat < 80; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(5));
    const SlopeView view =
        test::random_polytope(d, static_cast<int>(random.below(7)), repeat % 2 == 1, random);
    const oracle::Corners corners = oracle::enumerate_corners(view.slope, view.offset);
    LpSolver solver(view, GetParam());
    Basis last;
    for (int goal = 0; goal < 4; ++goal) {
      SCOPED_TRACE(std::to_string(repeat) + ", " + std::to_string(goal));
      const Objective objective = random_objective(view, random);
      const double best = best_corner(view, corners, objective, {});
      const LpAnswer cold = solver.maximise(objective, {});
      ASSERT_EQ(cold.status, LpStatus::kOptimal);
      EXPECT_NEAR(value_of(view, objective, cold), best, 1e-9);
      const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
      for (const Basis& from : {start, last, cold.basis}) {
        if (from.empty()) continue;
        const LpAnswer warm = solver.maximise(objective, from);
        ASSERT_EQ(warm.status, LpStatus::kOptimal);
        EXPECT_EQ(warm.attempts, 1);
        EXPECT_TRUE(std::is_sorted(warm.basis.begin(), warm.basis.end()));
        EXPECT_NEAR(value_of(view, objective, warm), best, 1e-9);
      }
      EXPECT_EQ(solver.maximise(objective, cold.basis).pivots, 0) << "an optimal start needs no pivot";
      last = cold.basis;
    }
  }
}

TEST_P(Formulations, GoOnFromTheLastVertex) {
  Random random(45);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const int d = 2 + static_cast<int>(random.below(4));
    const SlopeView view = test::random_polytope(d, 6, repeat % 2 == 1, random);
    const oracle::Corners corners = oracle::enumerate_corners(view.slope, view.offset);
    LpSolver solver(view, GetParam());
    Basis last = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    for (int goal = 0; goal < 20; ++goal) {
      const Objective objective = random_objective(view, random);
      const std::vector<int> held = goal % 3 == 2 ? std::vector<int>{last.front()} : std::vector<int>{};
      const LpAnswer answer = solver.maximise(objective, last, held);
      ASSERT_EQ(answer.status, LpStatus::kOptimal);
      EXPECT_EQ(answer.attempts, 1);
      EXPECT_NEAR(value_of(view, objective, answer), best_corner(view, corners, objective, held), 1e-9);
      last = answer.basis;
    }
  }
}

TEST_P(Formulations, AnotherStartForgetsWhatWasAskedBefore) {
  Random random(42);
  const SlopeView view = test::random_polytope(5, 12, true, random);
  const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(5), Eigen::VectorXd::Ones(5));
  LpSolver used(view, GetParam());
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Objective objective = random_objective(view, random);
    LpSolver fresh(view, GetParam());
    const LpAnswer first = used.maximise(objective, start);
    const LpAnswer second = fresh.maximise(objective, start);
    EXPECT_EQ(first.basis, second.basis);
    EXPECT_EQ(first.pivots, second.pivots);
  }
}

TEST_P(Formulations, HeldFacesAreKeptAndThenReleased) {
  Random random(43);
  test::expect_held_faces_are_kept_and_released(maker(GetParam()), random);
}

TEST_P(Formulations, TellUnboundedFromOptimal) {
  test::expect_unbounded_is_told_from_optimal(maker(GetParam()), {{}, {0, 1}});
}

TEST_P(Formulations, OneWordProvesAnOptimumAndTwoThatThereIsNone) {
  SlopeView view;  // z0 ≥ 0, z1 ≥ 0, z0 − z1 ≥ −1
  view.slope.resize(3, 2);
  view.slope << 1, 0, 0, 1, 1, -1;
  view.offset = Eigen::Vector3d(0, 0, 1);
  test::make_set(view);
  LpSolver solver(view, GetParam());
  const Objective grows = make_objective(view, {{0, 1.0}});
  const Objective limited = make_objective(view, {{0, -1.0}, {1, -1.0}});
  EXPECT_EQ(solver.maximise(limited, {0, 1}).solves, 1);
  EXPECT_EQ(solver.maximise(grows, {0, 1}).solves, 2);
  EXPECT_EQ(solver.maximise(limited, {0, 1}).solves, 1) << "the first formulation is asked first again";
  if (GetParam() == Formulation::kEdge) return;
  view.set.reset();  // leaves two formulations
  LpSolver without(view, GetParam());
  const LpAnswer answer = without.maximise(grows, {0, 1});
  EXPECT_EQ(answer.status, LpStatus::kUnbounded);
  EXPECT_EQ(answer.solves, 2);
}

TEST_P(Formulations, TellInfeasibleSets) {
  SlopeView view;  // z0 ≥ 1, z0 ≤ 0, z1 ∈ [0, 1]
  view.slope.resize(4, 2);
  view.slope << 1, 0, -1, 0, 0, 1, 0, -1;
  view.offset = Eigen::Vector4d(-1, 0, 0, 1);
  test::make_set(view);
  LpSolver solver(view, GetParam());
  const LpAnswer answer = solver.maximise(make_objective(view, {{2, 1.0}}), {});
  EXPECT_EQ(answer.status, LpStatus::kInfeasible);
  EXPECT_TRUE(answer.basis.empty());
}

INSTANTIATE_TEST_SUITE_P(Lp, Formulations,
                         testing::Values(Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge),
                         [](const auto& tested) { return to_string(tested.param); });

TEST(GlpkProblem, AFailedAssertionIsAnExceptionAndTheThreadGoesOn) {
  const auto make = [] { return std::make_unique<GlpkProblem>(1, 1, true); };
  const auto bystander = make();
  const auto broken = make();
  const GlpkProblem::Entry outside[] = {{7, 0, 1.0}};  // GLPK checks indices, and would end the process
  EXPECT_THROW(broken->load(outside), GlpkAborted);
  EXPECT_FALSE(broken->is_alive());
  EXPECT_FALSE(bystander->is_alive()) << "its memory belonged to the environment that was freed";

  const auto next = make();  // max x with −x ≥ −3, x ≥ 0
  const GlpkProblem::Entry inside[] = {{0, 0, -1.0}};
  next->load(inside);
  next->bound_row(0, GlpkProblem::Bound::kLower, -3);
  next->bound_column(0, GlpkProblem::Bound::kLower, 0);
  next->set_cost(0, 1);
  next->advanced_basis();
  EXPECT_EQ(next->solve({}), GlpkProblem::Result::kOptimal);
  EXPECT_TRUE(next->is_column_basic(0)) << "x = 3 lies between its bounds";
}

}  // namespace
}  // namespace indet
