#include "libindet/polytope/interior.h"

#include <gtest/gtest.h>

#include "libindet/base/random.h"
#include "tests/support/oracle.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

void expect_certificate(const SlopeView& view, const InteriorPoint& point) {
  EXPECT_GE(point.multipliers.minCoeff(), 0);
  EXPECT_NEAR(point.multipliers.sum(), 1, 1e-12);
  EXPECT_LE((view.slope.transpose() * point.multipliers).norm(), 1e-12);
  EXPECT_NEAR(point.multipliers.dot(view.offset), point.slack, 1e-12);
}

TEST(InteriorPoint, IsInside) {
  Random random(61);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const SlopeView view =
        test::random_polytope(1 + static_cast<int>(random.below(5)), 6, repeat % 2 == 1, random);
    const InteriorPoint point = find_interior_point(view, {});
    EXPECT_GT(point.slack, 0.1);
    EXPECT_NEAR((view.offset + view.slope * point.z).minCoeff(), point.slack, 1e-12);
    if (point.slack < 1) expect_certificate(view, point);
  }
}

TEST(InteriorPoint, OfAnEmptySetHasAFarkasCertificate) {
  Random random(62);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(4));
    SlopeView view = test::random_polytope(d, 4, false, random);
    view.offset -= Eigen::VectorXd::Constant(view.inequalities(), 3);
    ASSERT_EQ(oracle::enumerate_corners(view.slope, view.offset).vertices.rows(), 0);
    const InteriorPoint point = find_interior_point(view, {});
    EXPECT_LT(point.slack, 0);
    expect_certificate(view, point);
  }
}

TEST(InteriorPoint, OfAFlatSetNamesWhatHoldsWithEquality) {
  SlopeView view;  // z0 = 1 exactly, z1 ∈ [0, 1]
  view.slope.resize(4, 2);
  view.slope << 1, 0, -1, 0, 0, 1, 0, -1;
  view.offset = Eigen::Vector4d(-1, 1, 0, 1);
  const InteriorPoint point = find_interior_point(view, {});
  EXPECT_NEAR(point.slack, 0, 1e-14);
  expect_certificate(view, point);
  EXPECT_GT(point.multipliers.head(2).minCoeff(), 0.1);
  EXPECT_EQ(point.multipliers.tail(2).norm(), 0);
}

TEST(InteriorPoint, IsCappedWhereTheSetIsUnbounded) {
  SlopeView view;
  view.slope = Eigen::Matrix2d::Identity();
  view.offset = Eigen::Vector2d(-5, -7);
  const InteriorPoint point = find_interior_point(view, {});
  EXPECT_EQ(point.slack, 1);
  EXPECT_EQ(point.multipliers.norm(), 0);
}

TEST(RecessionRay, ExistsWhereTheSetIsUnbounded) {
  Random random(63);
  EXPECT_EQ(find_recession_ray(test::random_polytope(4, 5, true, random), {}).x.size(), 0);
  SlopeView view;  // the strip 0 ≤ z0 ≤ 1, z1 ≥ z0
  view.slope.resize(3, 2);
  view.slope << 1, 0, -1, 0, -1, 1;
  view.offset = Eigen::Vector3d(0, 1, 0);
  const Eigen::VectorXd ray = find_recession_ray(view, {}).x;
  ASSERT_EQ(ray.size(), 3);
  EXPECT_LE((ray - Eigen::Vector3d(0, 0, 1)).norm(), 1e-14);
}

}  // namespace
}  // namespace indet
