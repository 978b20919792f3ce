#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libindet/range/analyze.h"
#include "tests/support/body_variants.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// R_0, R_1 of zoo::wedge_with_levers at T_0 = T.
std::array<double, 2> normal_forces(double phi, double ratio, double T) {
  const double sum = (1 + (1 + ratio) * T * std::sin(phi)) / std::cos(phi);
  const double difference = -(1 - ratio) * T / std::tan(phi);
  return {(sum + difference) / 2, (sum - difference) / 2};
}

/// The largest T (sign 1), or −T (sign −1), with |T_0| ≤ μ R_0 and |T_1| ≤ μ R_1: each R is R' + slope T.
double largest_T(double phi, double mu, double ratio, int sign) {
  const auto at_0 = normal_forces(phi, ratio, 0);
  const auto at_1 = normal_forces(phi, ratio, sign);
  double largest = INFINITY;
  for (const int k : {0, 1}) {
    const double share = k == 0 ? 1 : ratio;
    const double slope = at_1[k] - at_0[k];
    if (share - mu * slope > 0) largest = std::min(largest, mu * at_0[k] / (share - mu * slope));
  }
  return largest;
}

TEST(Levers, OfAGrooveFollowTheClosedForm) {
  const double phi = 0.5;
  const double mu = 0.3;
  for (const auto& [lever_0, lever_1] : {std::pair(0.9, 0.9), {0.9, 1.0}, {1.0, 0.75}, {1.25, 0.8}}) {
    SCOPED_TRACE(testing::Message() << lever_0 << ", " << lever_1);
    const double ratio = lever_0 / lever_1;
    const ForceRanges ranges = analyze(zoo::wedge_with_levers(phi, mu, lever_0, lever_1));
    ASSERT_EQ(ranges.status, PolytopeStatus::kBounded);
    EXPECT_EQ(ranges.certified, 8);
    const double T_max = largest_T(phi, mu, ratio, 1);
    const double T_min = -largest_T(phi, mu, ratio, -1);
    EXPECT_NEAR(ranges.value(0, kMaxT), T_max, 1e-13);
    EXPECT_NEAR(ranges.value(0, kMinT), T_min, 1e-13);
    EXPECT_NEAR(ranges.value(1, kMaxT), -ratio * T_min, 1e-13);
    EXPECT_NEAR(ranges.value(1, kMinT), -ratio * T_max, 1e-13);
    for (const int k : {0, 1}) {
      const double low = normal_forces(phi, ratio, T_min)[k];
      const double high = normal_forces(phi, ratio, T_max)[k];
      EXPECT_NEAR(ranges.value(k, kMinR), std::min(low, high), 1e-13);
      EXPECT_NEAR(ranges.value(k, kMaxR), std::max(low, high), 1e-13);
    }
  }
}

TEST(Levers, OfTheLengthOfTheRadiusChangeNoBit) {
  Packing packing = zoo::random_pile(101, 12, 0.5);
  const ForceRanges plain = analyze(packing);
  ASSERT_NE(plain.status, PolytopeStatus::kEmpty);
  for (Contact& contact : packing.contacts) contact.lever_a = packing[contact.a].radius;
  EXPECT_TRUE(test::same_bytes(plain, analyze(packing)));
}

/// Levers that are all the same share of the radius leave every torque equation as it was.
TEST(Levers, OfOneShareOfTheRadiusLeaveTheRanges) {
  Packing packing = zoo::random_pile(101, 12, 0.5);
  const ForceRanges plain = analyze(packing);
  for (Contact& contact : packing.contacts) {
    contact.lever_a = 0.9 * packing[contact.a].radius;
    if (!contact.b.is_wall()) contact.lever_b = 0.9 * packing[contact.b.disk_id()].radius;
  }
  const ForceRanges shorter = analyze(packing);
  EXPECT_EQ(shorter.certified, plain.certified);
  EXPECT_TRUE(test::same_entries(plain.value, shorter.value, 1e-9));
}

TEST(FixedDisks, HoldADiskAsAGrooveDoes) {
  for (const double mu : {0.1, 0.3, 1.0}) {
    for (const double phi : {0.2, 0.6}) {
      const Packing packing = zoo::disk_on_two_fixed(phi, mu, 0.5, 3);
      const ForceRanges ranges = analyze(packing);
      const zoo::WedgeRanges exact = zoo::wedge_ranges(phi, mu);
      EXPECT_EQ(ranges.force_unit, 1) << "fixed disks weigh nothing";
      EXPECT_EQ(ranges.equations, 3);
      EXPECT_EQ(ranges.nullity, packing.expected_dimension());
      EXPECT_EQ(ranges.certified, 8);
      for (const int k : {0, 1}) {
        EXPECT_NEAR(ranges.value(k, kMinR), exact.R_min, 1e-12);
        EXPECT_NEAR(ranges.value(k, kMaxR), exact.R_max, 1e-12);
        EXPECT_NEAR(ranges.delta_T[k], exact.delta_T, 1e-12);
      }
    }
  }
}

TEST(FixedDisks, StandStillWhereOthersFall) {
  Packing packing = zoo::disk_on_two_fixed(0.5, 0.3, 1, 1);
  packing.contacts.erase(packing.contacts.begin());
  const ForceRanges ranges = analyze(packing);
  ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
  EXPECT_FALSE(ranges.doubtful);
  EXPECT_TRUE(test::is_falling_motion(packing, ranges.motion, 1e-8));
  EXPECT_TRUE(ranges.motion.bottomRows(2).isZero(0));
}

/// A fixed disk as body a, and as body b, is the same.
TEST(FixedDisks, MayBeEitherBodyOfAContact) {
  const Packing packing = zoo::with_levers(zoo::disk_on_two_fixed(0.5, 0.3, 0.5, 2), 1);
  const ForceRanges ranges = analyze(packing);
  const ForceRanges swapped = analyze(zoo::with_bodies_swapped(packing));
  EXPECT_EQ(ranges.certified, 8);
  EXPECT_EQ(swapped.certified, 8);
  EXPECT_TRUE(test::same_entries(ranges.value, swapped.value, 1e-12));
}

TEST(Bodies, RangesAreThoseOfAllVertices) {
  EXPECT_TRUE(rc::check([] {
    const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000000);
    Packing packing = zoo::random_pile(seed, *rc::gen::inRange(2, 5), -1);
    if (*rc::gen::element(true, false)) packing = zoo::with_fixed_disks(packing, seed);
    packing = zoo::with_levers(packing, seed);
    const ForceRanges ranges = analyze(packing);
    const oracle::States states = oracle::enumerate_states(packing);
    RC_ASSERT(ranges.dim == states.dim);
    for (int i = 0; states.dim >= 0 && i < packing.contact_count(); ++i) {
      for (int column = 0; column < 4; ++column) {
        const auto exact =
            oracle::extremum(states, 2 * i + (column >= kMinT ? 1 : 0), column % 2 == 0 ? -1 : 1);
        RC_ASSERT(test::near(exact.value, ranges.value(i, column) / ranges.force_unit, 1e-8));
      }
    }
  }));
}

}  // namespace
}  // namespace indet
