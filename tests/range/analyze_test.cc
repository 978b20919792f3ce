#include "libindet/range/analyze.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/equilibrium/contact_state.h"
#include "tests/range/formulations.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

double weight(const Eigen::VectorXd& state) {
  double sum = 0;
  for (Eigen::Index k = 0; k < state.size(); k += 2) sum += state[k];
  return sum;
}

/// Everything in `ranges` against all vertices and rays of F.
void expect_as_enumerated(const Packing& packing, const ForceRanges& ranges) {
  const oracle::States states = oracle::enumerate_states(packing);
  ASSERT_EQ(ranges.nullity, states.nullity);
  ASSERT_EQ(ranges.dim, states.dim);
  if (states.vertices.rows() == 0) {
    ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
    EXPECT_TRUE(test::is_falling_motion(packing, ranges.motion, 1e-8));
    EXPECT_EQ(ranges.certified, 0);
    return;
  }
  ASSERT_EQ(ranges.status, states.rays.rows() > 0 ? PolytopeStatus::kUnbounded
                           : states.dim == 0      ? PolytopeStatus::kPoint
                                                  : PolytopeStatus::kBounded);
  if (states.rays.rows() > 0) {
    EXPECT_TRUE(test::has_rays_where_infinite(packing, ranges, 1e-9));
  }
  EXPECT_EQ(ranges.certified, 4 * packing.contact_count());
  for (int i = 0; i < packing.contact_count(); ++i) {
    for (int column = 0; column < 4; ++column) {
      SCOPED_TRACE("contact " + std::to_string(i) + ", " + to_string(static_cast<Column>(column)));
      const int component = 2 * i + (column >= kMinT ? 1 : 0);
      const oracle::Answer exact = oracle::extremum(states, component, column % 2 == 0 ? -1 : 1);
      EXPECT_TRUE(test::near(exact.value, ranges.value(i, column) / ranges.force_unit, 1e-8))
          << exact.value << " " << ranges.value(i, column) / ranges.force_unit;
      if (std::isinf(exact.value)) {
        EXPECT_EQ(ranges.outcome(i, column), Outcome::kUnbounded);
        EXPECT_EQ(ranges.vertex(i, column), -1);
        continue;
      }
      EXPECT_EQ(ranges.unique(i, column) == 1, exact.unique);
      EXPECT_LE(ranges.lower(i, column), ranges.value(i, column));
      EXPECT_GE(ranges.upper(i, column), ranges.value(i, column));
      ASSERT_GE(ranges.vertex(i, column), 0);
      const Eigen::VectorXd state =
          ranges.states.row(ranges.vertex(i, column)).transpose() / ranges.force_unit;
      EXPECT_NEAR(state[component], exact.value, 1e-8 * std::max(1.0, std::abs(exact.value)));
      EXPECT_NEAR(weight(state), exact.smallest_weight, 1e-7 * std::max(1.0, exact.smallest_weight));
      if (exact.lightest.size() > 0) {
        EXPECT_TRUE(test::same_entries(exact.lightest, state, 1e-6));
      }
    }
  }
}

/// What double precision finds where rounding decides.
AnalyzeOptions in_doubles() {
  AnalyzeOptions options;
  options.exactness = AnalyzeOptions::Exactness::kNowhere;
  return options;
}

TEST(Analyze, DiskOnAFloorIsAPoint) {
  for (const double mu : {0.0, 0.3}) {
    const ForceRanges ranges = analyze(zoo::disk_on_floor(mu));
    EXPECT_EQ(ranges.status, PolytopeStatus::kPoint);
    EXPECT_EQ(ranges.dim, 0);
    EXPECT_EQ(ranges.determined, 4);
    EXPECT_NEAR(ranges.value(0, kMinR), 1, 1e-15);
    EXPECT_NEAR(ranges.value(0, kMaxR), 1, 1e-15);
    EXPECT_NEAR(ranges.value(0, kMaxT), 0, 1e-15);
    EXPECT_EQ(ranges.delta_R[0], 0);
    EXPECT_EQ(ranges.unknowns, mu > 0 ? 2 : 1);
    EXPECT_EQ(ranges.equations, mu > 0 ? 3 : 2);
  }
}

TEST(Analyze, DiskOnAnInclineRollsAtAnyFriction) {
  for (const double mu : {0.0, 0.3, 10.0, 1e6}) {
    const Packing packing = zoo::disk_on_incline(0.2, mu);
    const ForceRanges ranges = analyze(packing);
    EXPECT_EQ(ranges.status, PolytopeStatus::kEmpty);
    EXPECT_TRUE(test::is_falling_motion(packing, ranges.motion, 1e-9)) << mu;
    EXPECT_TRUE((ranges.outcome == Outcome::kNotRequested).all());
    EXPECT_EQ(ranges.states.rows(), 0);
  }
}

TEST(Analyze, PyramidStandsFromItsCriticalFrictionOn) {
  for (const double theta : {0.6, 0.9, 1.2}) {
    const double upper = std::tan(theta / 2);
    const double floor = upper / 3;
    const ForceRanges stands = analyze(zoo::pyramid(theta, upper * (1 + 1e-6), floor * (1 + 1e-6)));
    ASSERT_EQ(stands.status, PolytopeStatus::kPoint) << theta;
    EXPECT_NEAR(stands.value(0, kMaxR), 0.5, 1e-13);
    EXPECT_NEAR(stands.value(2, kMaxR), 1.5, 1e-13);
    EXPECT_NEAR(std::abs(stands.value(2, kMaxT)), upper / 2, 1e-13);
    for (const double shortage : {1e-6, 0.1}) {
      const double less = 1 - shortage;
      for (const auto& [a, b] : {std::pair(upper * less, floor * 2), std::pair(upper * 2, floor * less)}) {
        const Packing packing = zoo::pyramid(theta, a, b);
        const ForceRanges falls = analyze(packing);
        ASSERT_EQ(falls.status, PolytopeStatus::kEmpty) << theta;
        // So close to standing, the load works little for the size of the motion.
        EXPECT_TRUE(test::is_falling_motion(packing, falls.motion, 1e-3 * shortage));
        EXPECT_GT(falls.motion.rowwise().norm().minCoeff(), 0.01 * shortage) << "all three disks move";
      }
    }
  }
}

TEST(Analyze, PyramidAtItsCriticalFrictionIsAPoint) {
  const double upper = std::tan(0.4);
  const Packing packing = zoo::pyramid(0.8, upper, upper / 3);
  const ForceRanges ranges = analyze(packing, in_doubles());
  EXPECT_EQ(ranges.status, PolytopeStatus::kPoint);
  EXPECT_NEAR(ranges.value(0, kMaxR), 0.5, 1e-9);
  EXPECT_TRUE(ranges.doubtful);
  // The last digit of the tangent decides, and that it does is said.
  EXPECT_FALSE(analyze(packing).doubtful);
  EXPECT_LT(analyze(packing).hairline, 1e-9);
}

TEST(Analyze, FrictionlessColumnIsAPointWithHalfTheUnknowns) {
  constexpr int kCount = 12;
  const double theta = 0.5;
  const ForceRanges ranges = analyze(zoo::frictionless_column(kCount, theta));
  ASSERT_EQ(ranges.status, PolytopeStatus::kPoint);
  EXPECT_EQ(ranges.unknowns, 2 * kCount);
  EXPECT_EQ(ranges.equations, 2 * kCount);
  EXPECT_NEAR(ranges.value(0, kMinR), kCount, 1e-11);
  for (int k = 1; k < kCount; ++k) EXPECT_NEAR(ranges.value(k, kMinR), (kCount - k) / std::cos(theta), 1e-11);
  EXPECT_NEAR(ranges.value(kCount, kMinR), (kCount - 1) * std::tan(theta), 1e-11);
  for (int k = 1; k < kCount; ++k)
    EXPECT_NEAR(ranges.value(kCount + k, kMinR), (2 * (kCount - k) - 1) * std::tan(theta), 1e-11);
  EXPECT_TRUE((ranges.value.rightCols<2>() == 0).all());
}

TEST(Analyze, PinchedDiskHasDeterminedAndUnboundedForces) {
  const Packing packing = zoo::pinched_disk(0.25);
  for (const Formulation formulation : kFormulations) {
    const ForceRanges ranges = analyze_by(formulation, packing);
    ASSERT_EQ(ranges.status, PolytopeStatus::kUnbounded);
    EXPECT_NEAR(ranges.value(0, kMinR), 2, 1e-14);
    EXPECT_EQ(ranges.value(0, kMaxR), kInfinity);
    EXPECT_NEAR(ranges.value(0, kMinT), -0.5, 1e-14);
    EXPECT_NEAR(ranges.value(0, kMaxT), -0.5, 1e-14);
    EXPECT_NEAR(ranges.delta_T[0], 0, 1e-14);
    EXPECT_TRUE(std::isnan(ranges.d_R[0]));
    EXPECT_TRUE(test::has_rays_where_infinite(packing, ranges, 1e-14));
  }
}

/// Almost every vertex of it is degenerate, and GLPK can walk in circles among these.
TEST(Analyze, ALongRowTakesFewPivots) {
  constexpr int kCount = 40;
  constexpr double kMu = 0.3;
  AnalyzeOptions options;
  options.states.kind = StateChoice::Kind::kNone;
  options.reactions = false;
  const ForceRanges ranges = analyze(zoo::row_between_walls(kCount, kMu), options);
  EXPECT_EQ(ranges.status, PolytopeStatus::kUnbounded);
  EXPECT_EQ(ranges.dim, kCount + 2);
  EXPECT_EQ(ranges.failed, 0);
  EXPECT_LT(ranges.pivots, 40000);
  constexpr double kDown = (1 + 3 * kMu) / (2 - 2 * kMu);
  constexpr int kLeft = 2 * kCount - 1, kRight = 2 * kCount;
  EXPECT_NEAR(ranges.value(kLeft, kMinT), -0.5, 1e-9);
  EXPECT_NEAR(ranges.value(kLeft, kMaxT), kDown, 1e-9);
  EXPECT_NEAR(ranges.value(kRight, kMinT), -kDown, 1e-9);
  EXPECT_NEAR(ranges.value(kRight, kMaxT), 0.5, 1e-9);
  for (int k = 0; k < kCount; ++k) EXPECT_NEAR(ranges.value(k, kMinR), 0, 1e-9) << k;
}

TEST(Analyze, IndependentGroovesKeepTheirRanges) {
  const ForceRanges both = analyze(zoo::two_wedges(0.4, 0.3, 0.9, 0.5));
  EXPECT_EQ(both.blocks, 2);
  EXPECT_EQ(both.dim, 2);
  const zoo::WedgeRanges left = zoo::wedge_ranges(0.4, 0.3);
  const zoo::WedgeRanges right = zoo::wedge_ranges(0.9, 0.5);
  EXPECT_NEAR(both.delta_R[0], left.delta_R, 1e-13);
  EXPECT_NEAR(both.delta_R[3], right.delta_R, 1e-13);
  EXPECT_NEAR(both.delta_T[1], left.delta_T, 1e-13);
  EXPECT_NEAR(both.value(2, kMaxR), right.R_max, 1e-13);
  EXPECT_TRUE((both.unique == 0).all()) << "the other groove is free";
  // Where one is at an extremum, the other is at its lightest.
  const int row = both.vertex(0, kMaxR);
  EXPECT_NEAR(both.states(row, 4), right.R_min, 1e-13);
}

TEST(Analyze, AJammedGrooveLeavesTheOtherBounded) {
  const ForceRanges ranges = analyze(zoo::two_wedges(1.4, 0.3, 0.4, 0.3));
  EXPECT_EQ(ranges.status, PolytopeStatus::kUnbounded);
  EXPECT_EQ(ranges.value(0, kMaxR), kInfinity);
  EXPECT_NEAR(ranges.delta_R[2], zoo::wedge_ranges(0.4, 0.3).delta_R, 1e-13);
}

TEST(Analyze, CornerTransmitsOnlyWhereTheWallHolds) {
  const ForceRanges smooth = analyze(zoo::corner(0.3, 0.5));
  EXPECT_EQ(smooth.nullity, 1);
  EXPECT_EQ(smooth.dim, 0);
  EXPECT_EQ(smooth.status, PolytopeStatus::kPoint);
  EXPECT_EQ(smooth.value(1, kMaxR), 0);
  EXPECT_NEAR(smooth.value(0, kMaxR), 1, 1e-14);
  for (const double mu_wall : {1.0, 1.5}) {
    const ForceRanges rough = analyze(zoo::corner(0.4, mu_wall));
    ASSERT_EQ(rough.status, PolytopeStatus::kBounded);
    EXPECT_EQ(rough.dim, 1);
    EXPECT_NEAR(rough.value(1, kMinR), 0, 1e-14);
    EXPECT_NEAR(rough.value(1, kMaxR), 0.4 / 0.6, 1e-14);
    EXPECT_NEAR(rough.value(1, kMaxT), 0.4 / 0.6, 1e-14);
  }
  EXPECT_EQ(analyze(zoo::corner(1.2, 1.5)).status, PolytopeStatus::kUnbounded);
}

TEST(Analyze, SpunGrooveMustSlideAtItsCriticalTorque) {
  const double critical = zoo::spun_wedge_critical_torque(0.7, 0.3);
  expect_as_enumerated(zoo::spun_wedge(0.7, 0.3, 0.9 * critical),
                       analyze(zoo::spun_wedge(0.7, 0.3, 0.9 * critical)));
  const ForceRanges at = analyze(zoo::spun_wedge(0.7, 0.3, critical), in_doubles());
  EXPECT_EQ(at.status, PolytopeStatus::kPoint);
  EXPECT_EQ(at.nullity, 1);
  EXPECT_EQ(at.dim, 0);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(at.value(k, kMaxT), -0.3 * at.value(k, kMaxR), 1e-8);
  const Packing beyond = zoo::spun_wedge(0.7, 0.3, critical * (1 + 1e-6));
  const ForceRanges over = analyze(beyond);
  EXPECT_EQ(over.status, PolytopeStatus::kEmpty);
  EXPECT_TRUE(test::is_falling_motion(beyond, over.motion, 1e-9));
  EXPECT_EQ(analyze(zoo::spun_wedge(0.7, 0.3, critical * (1 - 1e-6))).dim, 1);
}

TEST(Analyze, AClosedContactLowersTheDimensionOnly) {
  const ForceRanges ranges = analyze(zoo::wedge_and_corner(0.5, 0.3));
  EXPECT_EQ(ranges.nullity, 2);
  EXPECT_EQ(ranges.dim, 1);
  EXPECT_EQ(ranges.status, PolytopeStatus::kBounded);
  EXPECT_NEAR(ranges.delta_R[0], zoo::wedge_ranges(0.5, 0.3).delta_R, 1e-13);
  EXPECT_EQ(ranges.value(3, kMaxR), 0);
  EXPECT_TRUE((ranges.unique.topRows(2) == 1).all());
}

TEST(Analyze, LooseDiskDropsOutUnlessSomethingPullsIt) {
  const ForceRanges quiet = analyze(zoo::wedge_and_loose_disk(0.5, 0.3, 0));
  EXPECT_EQ(quiet.status, PolytopeStatus::kBounded);
  EXPECT_EQ(quiet.equations, 3);
  EXPECT_NEAR(quiet.delta_R[0], zoo::wedge_ranges(0.5, 0.3).delta_R, 1e-13);
  const Packing packing = zoo::wedge_and_loose_disk(0.5, 0.3, 0.01);
  const ForceRanges pulled = analyze(packing);
  ASSERT_EQ(pulled.status, PolytopeStatus::kEmpty);
  EXPECT_TRUE(test::is_falling_motion(packing, pulled.motion, 1e-9));
  EXPECT_EQ(pulled.motion.row(0).norm(), 0);
  EXPECT_EQ(pulled.motion(1, 0), 1);
}

TEST(Analyze, NothingAtAllIsAPoint) {
  Packing packing;
  packing.named_force_unit = 1;
  EXPECT_EQ(analyze(packing).status, PolytopeStatus::kPoint);
  packing = zoo::wedge_and_loose_disk(0.5, 0.3, 0);
  packing.contacts.clear();
  packing.disks[0].load.setZero();
  const ForceRanges ranges = analyze(packing);
  EXPECT_EQ(ranges.status, PolytopeStatus::kPoint);
  EXPECT_EQ(ranges.objectives, 0);
}

TEST(Analyze, LatticePileAgreesWithEnumeration) {
  for (const double mu : {0.2, 0.3, 0.7}) {
    const Packing packing = zoo::lattice_pile(2, mu);
    for (const Formulation formulation : kFormulations) {
      SCOPED_TRACE(std::string(to_string(formulation)) + ", μ = " + std::to_string(mu));
      expect_as_enumerated(packing, analyze_by(formulation, packing));
    }
  }
}

TEST(Analyze, LargerLatticePileAgreesWithEnumeration) {
  for (const double mu : {0.4, 0.6})
    expect_as_enumerated(zoo::lattice_pile(3, mu), analyze(zoo::lattice_pile(3, mu)));
}

TEST(Analyze, SmallPilesAgreeWithEnumerationOfAllVertices) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Packing packing = zoo::random_pile(seed, 2 + static_cast<int>(seed % 4), seed % 2 == 0 ? -1 : 0.4);
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_as_enumerated(packing, analyze_by(kFormulations[seed % 3], packing));
    if (testing::Test::HasFailure()) break;
  }
}

/// Two blocks, and samples of 1 to 4 contacts: what is settled counts the objectives that were asked for.
TEST(Analyze, ProgressEndsWhenAllIsSettled) {
  for (const double angle : {0.4, 1.4}) {  // 1.4: unbounded
    const Packing packing = zoo::two_wedges(angle, 0.3, 0.9, 0.5);
    for (int sample = 1; sample <= packing.contact_count(); ++sample) {
      std::vector<std::int64_t> settled;
      AnalyzeOptions options;
      options.contacts = {ContactChoice::Kind::kSample, sample, 1, {}};
      options.progress = [&](const Progress& progress) {
        if (progress.stage != "force ranges") return true;
        EXPECT_EQ(progress.total, 4 * sample);
        settled.push_back(progress.done);
        return true;
      };
      const ForceRanges ranges = analyze(packing, options);
      EXPECT_EQ(ranges.blocks, 2);
      ASSERT_FALSE(settled.empty());
      EXPECT_TRUE(std::is_sorted(settled.begin(), settled.end()));
      EXPECT_EQ(settled.back(), ranges.objectives) << sample;
      if (sample == packing.contact_count()) {
        EXPECT_LT(settled.front(), ranges.objectives) << "one block";
      }
    }
  }
}

}  // namespace
}  // namespace indet
