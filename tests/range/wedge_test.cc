#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/range/analyze.h"
#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// The paper's two-contact packing (Sec. II H), see zoo::wedge.
class Wedge : public testing::TestWithParam<double> {
 protected:
  static constexpr int kAngles = 40;
  double mu() const { return GetParam(); }
  double critical_angle() const { return std::atan(1 / mu()); }
};

TEST_P(Wedge, IndeterminacyFollowsTheClosedForms) {
  for (int i = 1; i <= kAngles; ++i) {
    const double phi = critical_angle() * i / (kAngles + 1);
    const double amplification = std::max(1.0, 1 / (1 - mu() * std::tan(phi)));
    const zoo::WedgeRanges exact = zoo::wedge_ranges(phi, mu());
    const ForceRanges ranges = analyze(zoo::wedge(phi, mu()));
    SCOPED_TRACE(phi);
    ASSERT_EQ(ranges.status, PolytopeStatus::kBounded);
    EXPECT_EQ(ranges.nullity, 1);
    EXPECT_EQ(ranges.dim, 1);
    EXPECT_EQ(ranges.certified, 8);
    EXPECT_TRUE((ranges.unique == 1).all());
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(ranges.delta_R[k], exact.delta_R, 1e-12 * amplification);
      EXPECT_NEAR(ranges.delta_T[k], exact.delta_T, 1e-12 * amplification);
      EXPECT_NEAR(ranges.value(k, kMinR), exact.R_min, 1e-12 * amplification);
      EXPECT_NEAR(ranges.value(k, kMaxR), exact.R_max, 1e-12 * amplification);
    }
    EXPECT_NEAR(ranges.value(0, kMinT), exact.T_min, 1e-12 * amplification);
    EXPECT_NEAR(ranges.value(0, kMaxT), exact.T_max, 1e-12 * amplification);
    EXPECT_NEAR(ranges.value(1, kMinT), -exact.T_max, 1e-12 * amplification);
    EXPECT_NEAR(ranges.value(1, kMaxT), -exact.T_min, 1e-12 * amplification);
    // d_R: the distance of the two vertices; R_0, R_1, T_0 and T_1 all change.
    EXPECT_NEAR(ranges.d_R[0], std::sqrt(2.0) * std::hypot(exact.delta_R, exact.delta_T),
                1e-11 * amplification);
  }
}

TEST_P(Wedge, BeyondTheCriticalAngleTheForceIsUnlimited) {
  const double s = critical_angle();
  for (int i = 1; i <= kAngles; ++i) {
    const double phi = s + (M_PI / 2 - s) * i / (kAngles + 1);
    const double R_min = 0.5 / (std::cos(phi) + mu() * std::sin(phi));
    const Packing packing = zoo::wedge(phi, mu());
    const ForceRanges ranges = analyze(packing);
    SCOPED_TRACE(phi);
    ASSERT_EQ(ranges.status, PolytopeStatus::kUnbounded);
    EXPECT_TRUE(test::has_rays_where_infinite(packing, ranges, 1e-12));
    EXPECT_EQ(ranges.value(0, kMaxR), kInfinity);
    EXPECT_EQ(ranges.value(1, kMaxR), kInfinity);
    EXPECT_EQ(ranges.value(0, kMaxT), kInfinity);
    EXPECT_EQ(ranges.value(1, kMinT), -kInfinity);
    EXPECT_NEAR(ranges.value(0, kMinR), R_min, 1e-11);
    EXPECT_NEAR(ranges.value(0, kMinT), -mu() * R_min, 1e-11);
    EXPECT_EQ(ranges.delta_R[0], kInfinity);
    EXPECT_EQ(ranges.delta_T[1], kInfinity);
    EXPECT_EQ(ranges.unbounded, 4);
    EXPECT_EQ(ranges.certified, 8);
    EXPECT_EQ(ranges.outcome(0, kMaxR), Outcome::kUnbounded);
    EXPECT_EQ(ranges.outcome(0, kMinR), Outcome::kOptimal);
  }
}

TEST_P(Wedge, EitherSideOfTheCriticalAngleIsTold) {
  for (const double off : {1e-3, 1e-5, 1e-6}) {
    const ForceRanges below = analyze(zoo::wedge(critical_angle() - off, mu()));
    EXPECT_EQ(below.status, PolytopeStatus::kBounded) << off;
    const zoo::WedgeRanges exact = zoo::wedge_ranges(critical_angle() - off, mu());
    EXPECT_NEAR(below.delta_R[0] / exact.delta_R, 1, 1e-14 / off) << off;
    EXPECT_EQ(analyze(zoo::wedge(critical_angle() + off, mu())).status, PolytopeStatus::kUnbounded) << off;
  }
}

TEST_P(Wedge, SmallAnglesApproachTheLimitAndZeroIsAnotherPacking) {
  // δR → 0, δT → μ as φ → 0; at φ = 0 the contacts coincide: nullity 2, δR = 1.
  for (const double phi : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const ForceRanges ranges = analyze(zoo::wedge(phi, mu()));
    const zoo::WedgeRanges exact = zoo::wedge_ranges(phi, mu());
    SCOPED_TRACE(phi);
    EXPECT_EQ(ranges.nullity, 1);
    EXPECT_EQ(ranges.imprecise + ranges.failed, 0);
    EXPECT_NEAR(ranges.delta_R[0], exact.delta_R, 1e-15 / phi);
    EXPECT_NEAR(ranges.delta_T[0], exact.delta_T, 1e-15 / phi);
  }
  const ForceRanges ranges = analyze(zoo::wedge(0, mu()));
  EXPECT_EQ(ranges.nullity, 2);
  EXPECT_EQ(ranges.dim, 2);
  EXPECT_NEAR(ranges.delta_R[0], 1, 1e-14);
  EXPECT_NEAR(ranges.delta_T[0], mu(), 1e-14);  // T_0 = −T_1, |T| ≤ μ min(R_0, R_1) ≤ μ/2
}

TEST_P(Wedge, ADoubtfulRankIsNeverPassedOverInSilence) {
  // The smallest singular value is about φ: between the two rank tolerances it is doubtful.
  for (const double phi : {1e-10, 3e-11, 1e-11, 3e-12, 1e-12, 5e-13}) {
    AnalyzeOptions options;
    options.exact_work = 0;
    const ForceRanges ranges = analyze(zoo::wedge(phi, mu()), options);
    const bool right = ranges.nullity == 1 && std::abs(ranges.delta_R[0] - mu() * phi) < 1e-15 / phi &&
                       std::abs(ranges.delta_T[0] - mu()) < 1e-15 / phi;
    EXPECT_TRUE(right || ranges.certified == 0) << phi << " δR " << ranges.delta_R[0];
    EXPECT_EQ(ranges.rank_ambiguous, ranges.certified == 0);
    if (phi < 3e-12) {
      EXPECT_EQ(ranges.imprecise, 8) << phi;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, Wedge, testing::Values(0.1, 0.3, 1.0));

}  // namespace
}  // namespace indet
