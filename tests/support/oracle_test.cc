#include "tests/support/oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet::oracle {
namespace {

TEST(Oracle, ChoicesAreAllThereAre) {
  int count = 0;
  for_each_choice(6, 3, [&](const std::vector<int>&) { ++count; });
  EXPECT_EQ(count, 20);
  count = 0;
  for_each_choice(4, 0, [&](const std::vector<int>&) { ++count; });
  EXPECT_EQ(count, 1);
  for_each_choice(2, 3, [&](const std::vector<int>&) { ++count; });
  EXPECT_EQ(count, 1);
}

TEST(Oracle, UnitSquareHasFourCornersAndNoRay) {
  Eigen::MatrixXd slope(4, 2);
  slope << 1, 0, 0, 1, -1, 0, 0, -1;
  const Corners corners = enumerate_corners(slope, Eigen::Vector4d(0, 0, 1, 1));
  EXPECT_EQ(corners.vertices.rows(), 4);
  EXPECT_EQ(corners.rays.rows(), 0);
}

TEST(Oracle, QuadrantHasOneCornerAndTwoRays) {
  const Corners corners = enumerate_corners(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero());
  EXPECT_EQ(corners.vertices.rows(), 1);
  EXPECT_EQ(corners.rays.rows(), 2);
}

TEST(Oracle, KnowsTheGroove) {
  const States states = enumerate_states(zoo::wedge(0.6, 0.3));
  const zoo::WedgeRanges exact = zoo::wedge_ranges(0.6, 0.3);
  EXPECT_EQ(states.nullity, 1);
  EXPECT_EQ(states.dim, 1);
  EXPECT_NEAR(extremum(states, 0, -1).value, exact.R_min, 1e-12);
  EXPECT_NEAR(extremum(states, 2, 1).value, exact.R_max, 1e-12);
  EXPECT_NEAR(extremum(states, 1, -1).value, exact.T_min, 1e-12);
  EXPECT_NEAR(extremum(states, 1, 1).value, exact.T_max, 1e-12);
  EXPECT_TRUE(extremum(states, 0, 1).unique);
  EXPECT_NEAR(extremum(states, 0, 1).smallest_weight, 2 * exact.R_max, 1e-12);
}

TEST(Oracle, KnowsWhatIsUnboundedAndWhatIsNot) {
  const States states = enumerate_states(zoo::pinched_disk(0.25));
  EXPECT_EQ(states.dim, 1);
  EXPECT_EQ(states.rays.rows(), 1);
  EXPECT_NEAR(extremum(states, 0, -1).value, 2, 1e-12);
  EXPECT_EQ(extremum(states, 0, 1).value, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(extremum(states, 1, 1).value, -0.5, 1e-12);
  EXPECT_FALSE(extremum(states, 1, 1).unique);
}

TEST(Oracle, KnowsWhatCannotStand) {
  EXPECT_EQ(enumerate_states(zoo::disk_on_incline(0.1, 10)).vertices.rows(), 0);
  EXPECT_EQ(enumerate_states(zoo::pyramid(0.8, 0.1, 1)).vertices.rows(), 0);
  EXPECT_EQ(enumerate_states(zoo::pyramid(0.8, 1, 1)).vertices.rows(), 1);
}

}  // namespace
}  // namespace indet::oracle
