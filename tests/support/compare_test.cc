#include "tests/support/compare.h"

#include <gtest/gtest.h>

#include <limits>

#include "libindet/range/analyze.h"
#include "tests/support/zoo.h"

namespace indet::test {
namespace {

// Each comparator must be able to fail.

TEST(Compare, NearTellsInfinitiesApart) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(near(infinity, infinity, 1e-9));
  EXPECT_FALSE(near(infinity, -infinity, 1e-9));
  EXPECT_FALSE(near(infinity, 1, 1e-9));
  EXPECT_FALSE(near(1, ForceRanges::kNaN, 1e-9));
  EXPECT_TRUE(near(1000, 1000 + 1e-7, 1e-9));
  EXPECT_FALSE(near(1, 1 + 1e-7, 1e-9));
}

TEST(Compare, SameBytesSeesOneChangedBit) {
  const ForceRanges ranges = analyze(zoo::wedge(0.4, 0.3));
  EXPECT_TRUE(same_bytes(ranges, ranges));
  ForceRanges changed = ranges;
  changed.value(1, kMaxT) = std::nextafter(changed.value(1, kMaxT), 10);
  EXPECT_FALSE(same_bytes(ranges, changed));
  changed = ranges;
  ++changed.pivots;
  EXPECT_FALSE(same_bytes(ranges, changed));
  changed = ranges;
  changed.unique(0, 0) = 2;
  EXPECT_FALSE(same_bytes(ranges, changed));
  changed = ranges;
  changed.seconds["ranges"] += 1;
  EXPECT_TRUE(same_bytes(ranges, changed));
}

TEST(Compare, SameRangesSeesValueOutcomeFlagAndState) {
  const ForceRanges ranges = analyze(zoo::wedge(0.4, 0.3));
  EXPECT_TRUE(same_ranges(ranges, ranges, 1e-12));
  ForceRanges changed = ranges;
  changed.value(0, kMinR) += 1e-6;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  changed = ranges;
  changed.outcome(0, kMinR) = Outcome::kImprecise;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  changed = ranges;
  changed.unique(0, kMinR) = 1 - changed.unique(0, kMinR);
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  changed = ranges;
  changed.states.array() += 1e-6;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  EXPECT_FALSE(same_ranges_and_weights(ranges, changed, 1e-9));
  changed = ranges;
  changed.states.col(1).array() += 1e-6;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  EXPECT_TRUE(same_ranges_and_weights(ranges, changed, 1e-9)) << "normal forces are the same";
  EXPECT_FALSE(same_ranges(ranges, mirrored(ranges), 1e-9));
}

TEST(Compare, FallingMotionIsMultipliedBack) {
  const Packing packing = zoo::disk_on_incline(0.3, 0.5);
  // Rolling down: centre along (cos, −sin), turning so that the point of contact rests.
  Eigen::MatrixXd motion(1, 3);
  motion << std::cos(0.3), -std::sin(0.3), -1;
  EXPECT_TRUE(is_falling_motion(packing, motion, 1e-12));
  EXPECT_FALSE(is_falling_motion(packing, -motion, 1e-12)) << "uphill";
  motion(0, 2) = 0;
  motion /= motion.cwiseAbs().maxCoeff();
  EXPECT_FALSE(is_falling_motion(packing, motion, 1e-12)) << "slides against friction";
  EXPECT_FALSE(is_falling_motion(packing, 2 * motion, 1e-12)) << "not normalised";
}

TEST(Compare, RayIsMultipliedBack) {
  const Packing packing = zoo::pinched_disk(0.3);
  EXPECT_TRUE(is_recession_ray(packing, Eigen::Vector4d(1, 0, 1, 0), 1e-12));
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d(1, 0, 2, 0), 1e-12)) << "not balanced";
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d(-1, 0, -1, 0), 1e-12)) << "pulls";
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d(1, 0.5, 1, -0.5), 1e-12)) << "beyond friction";
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d::Zero(), 1e-12));
}

TEST(Compare, EveryInfiniteEndNeedsItsOwnRay) {
  const Packing packing = zoo::wedge(1.4, 0.3);
  const ForceRanges ranges = analyze(packing);
  EXPECT_TRUE(has_rays_where_infinite(packing, ranges, 1e-12));
  ForceRanges changed = ranges;
  changed.ray(0, kMaxR) = -1;
  EXPECT_FALSE(has_rays_where_infinite(packing, changed, 1e-12));
  changed = ranges;
  changed.value(0, kMaxR) *= -1;
  EXPECT_FALSE(has_rays_where_infinite(packing, changed, 1e-12));
  changed = ranges;
  changed.rays(0, 0) += 0.1;
  EXPECT_FALSE(has_rays_where_infinite(packing, changed, 1e-12));
}

}  // namespace
}  // namespace indet::test
