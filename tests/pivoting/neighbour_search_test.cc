#include "libindet/pivoting/neighbour_search.h"

#include <gtest/gtest.h>

#include <string>

#include "libindet/base/random.h"
#include "libindet/lp/purification.h"
#include "tests/support/oracle.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

constexpr double kEpsilon = 1e-9;

double best_corner(const SlopeView& view, const Objective& objective) {
  return (oracle::enumerate_corners(view.slope, view.offset).vertices * objective.along_z).maxCoeff();
}

/// The square [0, 1]², and more half-planes.
SlopeView square(const Eigen::MatrixXd& more, const Eigen::VectorXd& offsets) {
  SlopeView view;
  view.slope.resize(4 + more.rows(), 2);
  view.slope << 1, 0, 0, 1, -1, 0, 0, -1, more;
  view.offset.resize(4 + more.rows());
  view.offset << 0, 0, 1, 1, offsets;
  return view;
}

TEST(NeighbourSearch, ClimbsToTheBestCornerOfSimplePolytopes) {
  Random random(71);
  for (int repeat = 0; repeat < 60; ++repeat) {
    SCOPED_TRACE(repeat);
    const int d = 1 + static_cast<int>(random.below(5));
    const SlopeView view = test::random_polytope(d, static_cast<int>(random.below(7)), false, random);
    std::vector<std::pair<int, double>> on_edges;
    for (int k = 0; k < view.inequalities(); ++k) on_edges.emplace_back(k, random.normal());
    const Objective objective = make_objective(view, on_edges);
    const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Zero(d));
    for (const NeighbourRule rule : kNeighbourRules) {
      SCOPED_TRACE(to_string(rule));
      const NeighbourWalk walk = NeighbourSearch(view, kEpsilon, rule).walk(objective, start);
      EXPECT_EQ(walk.end, WalkEnd::kNoneBetter);
      if (rule == NeighbourRule::kBest) {
        EXPECT_EQ(walk.neighbours, d * (walk.steps + 1)) << "all neighbours of every point are looked at";
      } else {
        EXPECT_GE(walk.neighbours, d + walk.steps) << "all of the last point, one at least of every other";
        EXPECT_LE(walk.neighbours, d * (walk.steps + 1));
      }
      EXPECT_EQ(walk.unexpected, 0);
      const Vertex vertex = compute_vertex(view, walk.basis);
      EXPECT_NEAR(objective.along_z.dot(vertex.z), best_corner(view, objective), 1e-9);
    }
  }
}

/// A prism [0, 1] × {triangle 0, (2, 0), (0, 3)} on whose far edge from (2, 0) to (0, 3) z1/2 + z2/3 is the
/// same everywhere: planes 0 to 4 are z0, z1, z2 ≥ 0, z0 ≤ 1, z1/2 + z2/3 ≤ 1.
SlopeView prism() {
  SlopeView view;
  view.slope.resize(5, 3);
  view.slope << 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1 / 2.0, -1 / 3.0;
  view.offset.resize(5);
  view.offset << 0, 0, 0, 1, 1;
  return view;
}

TEST(NeighbourSearch, GoesToTheFirstBetterNeighbourInTheOrderOfTheList) {
  // Up is z1 + 1.4 z2, so that the edge of plane 4 is the last step.
  const SlopeView view = prism();
  const Objective up = make_objective(view, {{1, 1.0}, {2, 1.4}});
  const NeighbourSearch first(view, kEpsilon, NeighbourRule::kFirst);
  // Relaxing 0 leads along z0 and gains nothing, 1 leads to (0, 2, 0), which is better: 2 is not looked at.
  // There the list is {0, 4, 2}; relaxing 2 leads along the edge of 4 to (0, 0, 3), the list of which is
  // {0, 4, 1}.
  const NeighbourWalk walk = first.walk(up, {0, 1, 2});
  EXPECT_EQ(walk.basis, (Basis{0, 1, 4}));
  EXPECT_EQ(walk.steps, 2);
  EXPECT_EQ(walk.neighbours, 2 + 3 + 3);
  // In another order of the list, (0, 0, 3) is the first better neighbour.
  const NeighbourWalk other = first.walk(up, {2, 0, 1});
  EXPECT_EQ(other.basis, walk.basis);
  EXPECT_EQ(other.steps, 1);
  EXPECT_EQ(other.neighbours, 1 + 3);
}

TEST(NeighbourSearch, TheOrderOfTheListDecidesAmongOptimalPoints) {
  // The whole edge of plane 4 is optimal.
  const SlopeView view = prism();
  const Objective up = make_objective(view, {{4, -1.0}});
  const auto end_by = [&](NeighbourRule rule, const Basis& start) {
    return NeighbourSearch(view, kEpsilon, rule).walk(up, start).basis;
  };
  EXPECT_EQ(end_by(NeighbourRule::kFirst, {0, 1, 2}), (Basis{0, 2, 4}));
  EXPECT_EQ(end_by(NeighbourRule::kFirst, {0, 2, 1}), (Basis{0, 1, 4}));
}

TEST(NeighbourSearch, GoesToTheBestOfTheNeighbours) {
  // From the origin both axes lead up; the far corner of the longer one is better.
  SlopeView view = square(Eigen::MatrixXd(0, 2), Eigen::VectorXd(0));
  view.offset[3] = 5;
  const Objective up = make_objective(view, {{0, 1.0}, {1, 1.0}});
  const NeighbourWalk walk = NeighbourSearch(view, kEpsilon, NeighbourRule::kBest).walk(up, {0, 1});
  EXPECT_EQ(walk.basis, (Basis{2, 3}));
  EXPECT_EQ(walk.steps, 2);
  const SlopeView high = prism();
  const Objective along = make_objective(high, {{1, 1.0}, {2, 1.4}});
  EXPECT_EQ(NeighbourSearch(high, kEpsilon, NeighbourRule::kBest).walk(along, {0, 1, 2}).steps, 1);
}

TEST(NeighbourSearch, DrawsItsOrderFromTheSeedAndTheNumberOfTheWalk) {
  const SlopeView view = prism();
  const Objective up = make_objective(view, {{4, -1.0}});
  int ends[2] = {0, 0};
  for (std::uint64_t number = 0; number < 100; ++number) {
    const NeighbourSearch search(view, kEpsilon, NeighbourRule::kRandom, 3);
    const NeighbourWalk walk = search.walk(up, {0, 1, 2}, number);
    EXPECT_EQ(walk.basis, search.walk(up, {0, 1, 2}, number).basis);
    ++ends[walk.basis == Basis{0, 1, 4} ? 0 : 1];
  }
  EXPECT_NEAR(ends[0], 50, 15);
  EXPECT_NEAR(ends[1], 50, 15);
}

TEST(NeighbourSearch, ReportsPointsWithMoreActiveConstraintsThanDimensions) {
  // The line z0 + z1 = 0 touches the square in the corner from which the walk starts.
  const SlopeView touched = square(Eigen::RowVector2d(1, 1), Eigen::VectorXd::Zero(1));
  const Objective up = make_objective(touched, {{0, 1.0}});
  const NeighbourWalk passed = NeighbourSearch(touched, kEpsilon, NeighbourRule::kFirst).walk(up, {0, 1});
  EXPECT_EQ(passed.end, WalkEnd::kNoneBetter);
  EXPECT_EQ(passed.unexpected, 1);
  const NeighbourWalk stays = NeighbourSearch(touched, kEpsilon, NeighbourRule::kFirst)
                                  .walk(make_objective(touched, {{4, -1.0}}), {0, 1});
  EXPECT_EQ(stays.end, WalkEnd::kMoreActive);
  EXPECT_EQ(stays.steps, 0);
}

TEST(NeighbourSearch, IsCaughtInACornerAsThePaperIs) {
  // A square pyramid stood on its tip: four planes z2 ≥ |z0|, z2 ≥ |z1| meet at the origin, and from a basis
  // of three of them every edge that gains is blocked at once.
  SlopeView view;
  view.slope.resize(5, 3);
  view.slope << 1, 0, 1, -1, 0, 1, 0, 1, 1, 0, -1, 1, 0, 0, -1;
  view.offset.resize(5);
  view.offset << 0, 0, 0, 0, 1;
  const Objective objective = make_objective(view, {{3, -1.0}, {0, -1.0}});
  int caught = 0;
  oracle::for_each_choice(4, 3, [&](const std::vector<int>& start) {
    const NeighbourWalk walk = NeighbourSearch(view, kEpsilon, NeighbourRule::kFirst).walk(objective, start);
    const double value = objective.along_z.dot(compute_vertex(view, walk.basis).z);
    if (walk.end == WalkEnd::kNoneBetter) {
      EXPECT_NEAR(value, best_corner(view, objective), 1e-9);
    }
    caught += walk.end == WalkEnd::kMoreActive ? 1 : 0;
  });
  EXPECT_GT(caught, 0);
}

TEST(NeighbourSearch, ReportsEdgesWithoutEnd) {
  SlopeView view;  // the quadrant
  view.slope = Eigen::Matrix2d::Identity();
  view.offset = Eigen::Vector2d::Zero();
  const NeighbourSearch search(view, kEpsilon, NeighbourRule::kFirst);
  EXPECT_EQ(search.walk(make_objective(view, {{0, 1.0}}), {0, 1}).end, WalkEnd::kPolytopeEdgeWithoutEnd);
  EXPECT_EQ(search.walk(make_objective(view, {{0, -1.0}}), {0, 1}).end, WalkEnd::kNoneBetter);
}

TEST(NeighbourSearch, ReportsLostDirections) {
  SlopeView view = square(Eigen::RowVector2d(1, 1e-14), Eigen::VectorXd::Zero(1));
  EXPECT_EQ(NeighbourSearch(view, kEpsilon, NeighbourRule::kFirst)
                .walk(make_objective(view, {{1, 1.0}}), {0, 4})
                .end,
            WalkEnd::kDirectionsLost);
}

}  // namespace
}  // namespace indet
