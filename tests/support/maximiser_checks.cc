#include "tests/support/maximiser_checks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "tests/support/objectives.h"
#include "tests/support/oracle.h"
#include "tests/support/sets.h"

namespace indet::test {

void expect_held_faces_are_kept_and_released(const MakeMaximiser& make, Random& random) {
  for (int repeat = 0; repeat < 60; ++repeat) {
    SCOPED_TRACE(repeat);
    const int d = 2 + static_cast<int>(random.below(3));
    const SlopeView view = random_polytope(d, 5, repeat % 2 == 1, random);
    const oracle::Corners corners = oracle::enumerate_corners(view.slope, view.offset);
    const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    const Vertex vertex = compute_vertex(view, start);
    std::vector<int> held;
    for (int k = 0; k < view.inequalities(); ++k) {
      if (std::abs(vertex.x[k]) < 1e-12 && random.below(2) == 0) held.push_back(k);
    }
    const std::unique_ptr<Maximiser> method = make(view);
    const Objective objective = random_objective(view, random);
    const LpAnswer on_face = method->maximise(objective, start, held);
    ASSERT_EQ(on_face.status, LpStatus::kOptimal);
    EXPECT_NEAR(value_of(view, objective, on_face), best_corner(view, corners, objective, held), 1e-9);
    const Vertex found = compute_vertex(view, on_face.basis);
    for (const int k : held) EXPECT_NEAR(found.x[k], 0, 1e-12);
    const LpAnswer free = method->maximise(objective, start);
    ASSERT_EQ(free.status, LpStatus::kOptimal);
    EXPECT_NEAR(value_of(view, objective, free), best_corner(view, corners, objective, {}), 1e-9);
  }
}

void expect_unbounded_is_told_from_optimal(const MakeMaximiser& make, const std::vector<Basis>& starts) {
  SlopeView view;
  view.slope.resize(3, 2);
  view.slope << 1, 0, 0, 1, 1, -1;
  view.offset = Eigen::Vector3d(0, 0, 1);
  make_set(view);
  const std::unique_ptr<Maximiser> method = make(view);
  for (const Basis& start : starts) {
    EXPECT_EQ(method->maximise(make_objective(view, {{0, 1.0}}), start).status, LpStatus::kUnbounded);
    EXPECT_EQ(method->maximise(make_objective(view, {{1, 1.0}}), start).status, LpStatus::kUnbounded);
    const Objective down = make_objective(view, {{1, 1.0}, {0, -2.0}});
    const LpAnswer answer = method->maximise(down, start);
    ASSERT_EQ(answer.status, LpStatus::kOptimal);
    EXPECT_EQ(value_of(view, down, answer), 1);
  }
}

}  // namespace indet::test
