#include "libindet/range/reactions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/range/analyze.h"
#include "tests/support/body_variants.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// Minimum or maximum over vertices and rays that were enumerated.
double enumerated(const oracle::States& states, const Eigen::VectorXd& coefficients, int sign) {
  const Eigen::VectorXd growth = sign * (states.rays * coefficients);
  if (growth.size() > 0 && growth.maxCoeff() > 1e-9) return sign * kInfinity;
  return sign * (sign * (states.vertices * coefficients)).maxCoeff();
}

void expect_enumerated(const Packing& packing) {
  const ForceRanges ranges = analyze(packing);
  const oracle::States states = oracle::enumerate_states(packing);
  const std::vector<ReactionSum> sums = reaction_sums(packing);
  const Reactions& found = ranges.reactions;
  ASSERT_EQ(found.count(), std::ssize(sums));
  for (Eigen::Index k = 0; k < found.count(); ++k) {
    const ReactionSum& sum = sums[static_cast<std::size_t>(k)];
    EXPECT_EQ(found.body[k], sum.body.code());
    EXPECT_EQ(found.component[k], sum.component);
    for (const int end : {0, 1}) {
      if (states.dim < 0) {
        EXPECT_EQ(found.outcome(k, end), Outcome::kNotRequested);
        EXPECT_TRUE(std::isnan(found.value(k, end)));
        continue;
      }
      const double exact = enumerated(states, sum.coefficients, end == 0 ? -1 : 1) * ranges.force_unit;
      EXPECT_TRUE(test::near(exact, found.value(k, end), 1e-8))
          << exact << " against " << found.value(k, end) << ", row " << k << ", end " << end;
      EXPECT_LE(found.lower(k, end), found.value(k, end));
      EXPECT_GE(found.upper(k, end), found.value(k, end));
      if (!ranges.doubtful) {
        EXPECT_EQ(found.outcome(k, end), std::isinf(exact) ? Outcome::kUnbounded : Outcome::kOptimal);
      }
      if (ranges.status == PolytopeStatus::kBounded && !ranges.doubtful) {
        EXPECT_LT(found.upper(k, end) - found.lower(k, end), 1e-8 * ranges.force_unit);
      }
    }
  }
}

TEST(Reactions, AreThoseOfAllVertices) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Packing packing = zoo::random_pile(seed, 2 + static_cast<int>(seed % 3), -1);
    if (seed % 2 == 1) packing = zoo::with_fixed_disks(packing, seed);
    if (seed % 4 > 1) packing = zoo::with_levers(packing, seed);
    expect_enumerated(packing);
  }
}

TEST(Reactions, AreThoseOfAllVerticesInBlocksAndWhereForcesAreUnbounded) {
  for (const Packing& packing :
       {zoo::two_wedges(0.4, 0.3, 0.6, 0.2), zoo::pinched_disk(0.4), zoo::wedge(1.4, 0.3),
        zoo::corner(0.5, 1.2), zoo::column_between_walls(2, 0.3), zoo::disk_on_incline(0.3, 0.5),
        zoo::disk_on_floor(0)})
    expect_enumerated(packing);
}

TEST(Reactions, OfLoadedWallsAreTheirLoads) {
  Packing packing = zoo::disks_between_plates(3, 2.5, 0.3);
  packing.walls[1].load_t = 0;
  const Reactions found = analyze(packing).reactions;
  // floor: ΣR, ΣT; plate: ΣR, ΣT
  ASSERT_EQ(found.count(), 4);
  const double expected[] = {5.5, 0, 2.5, 0};
  for (Eigen::Index k = 0; k < 4; ++k) {
    for (const int end : {0, 1}) EXPECT_NEAR(found.value(k, end), expected[k], 1e-13);
  }
}

/// All of the weight rests on the two fixed disks; each bears half of it, by symmetry of T_0 = −T_1.
TEST(Reactions, OfFixedDisksHoldTheWeight) {
  const Packing packing = zoo::disk_on_two_fixed(0.5, 0.3, 1, 2);
  const ForceRanges ranges = analyze(packing);
  const Reactions& found = ranges.reactions;
  ASSERT_EQ(found.count(), 6);
  for (const Eigen::Index y : {1, 4}) {
    EXPECT_NEAR(found.value(y, 0), -0.5, 1e-13);
    EXPECT_NEAR(found.value(y, 1), -0.5, 1e-13);
  }
  // The torque on the larger one: its radius times T.
  EXPECT_NEAR(found.value(5, 1), 2 * ranges.value(1, kMaxT), 1e-12);
}

TEST(Reactions, EncloseTheExactValue) {
  // A groove: with symmetric contacts the wall's R has the closed form of wedge_ranges.
  const zoo::WedgeRanges exact = zoo::wedge_ranges(0.5, 0.3);
  const Reactions found = analyze(zoo::wedge(0.5, 0.3)).reactions;
  ASSERT_EQ(found.count(), 4);
  EXPECT_NEAR(found.value(0, 0), exact.R_min, 1e-13);
  EXPECT_NEAR(found.value(0, 1), exact.R_max, 1e-13);
  EXPECT_LE(found.lower(0, 1), exact.R_max + 1e-15);
  EXPECT_GE(found.upper(0, 1), exact.R_max - 1e-15);
  EXPECT_LT(found.upper(0, 1) - found.lower(0, 1), 1e-12);
}

}  // namespace
}  // namespace indet
