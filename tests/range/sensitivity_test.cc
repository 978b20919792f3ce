#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/range/analyze.h"
#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

constexpr double kAngle = 1e-7;

/// The packing with the normal of contact i turned by kAngle · turn(i).
Packing turned(const Packing& packing, const std::function<double(std::size_t)>& turn) {
  Packing result = packing;
  for (std::size_t i = 0; i < result.contacts.size(); ++i)
    result.contacts[i].normal = Eigen::Rotation2Dd(kAngle * turn(i)) * packing.contacts[i].normal;
  return result;
}

/// How far each value moved, per radian; infinite where there is none any more, 0 where the packing falls.
Table4<double> moved(const ForceRanges& before, const ForceRanges& after) {
  if (after.status == PolytopeStatus::kEmpty) return Table4<double>::Zero(before.value.rows(), 4);
  Table4<double> result = (after.value - before.value).abs() / kAngle;
  return result.isNaN().select(INFINITY, result);
}

bool has_claim(const ForceRanges& ranges, Eigen::Index k, SensitivityClaim claim) {
  return ranges.sensitivity.claim.data()[k] == static_cast<std::uint8_t>(claim);
}

/// Values that moved further than is stored, beyond what is not of first order.
int further_than_stored(const ForceRanges& ranges, const Table4<double>& moved) {
  int count = 0;
  for (Eigen::Index k = 0; k < moved.size(); ++k) {
    if (!std::isfinite(ranges.value.data()[k])) continue;
    const double bound = ranges.sensitivity.value.data()[k];
    if (moved.data()[k] > bound * (1 + 1e-4) + 1e-4) {
      ++count;
      ADD_FAILURE() << "contact " << k / 4 << ", column " << k % 4 << " moves by " << moved.data()[k]
                    << ", stored is " << bound;
    }
  }
  return count;
}

/// Turns in `count` directions: angles anywhere up to kAngle, or all of kAngle.
void expect_bounds(const Packing& packing, int count, std::uint64_t seed) {
  const ForceRanges ranges = analyze(packing);
  if (ranges.status == PolytopeStatus::kEmpty || ranges.doubtful) return;
  Random random(seed);
  for (int k = 0; k < count; ++k) {
    const bool is_full = k % 2 == 0;
    const ForceRanges after = analyze(turned(packing, [&](std::size_t) {
      const double turn = random.uniform(-1, 1);
      return is_full ? std::copysign(1.0, turn) : turn;
    }));
    if (further_than_stored(ranges, moved(ranges, after)) > 0) return;
  }
}

TEST(Sensitivity, NothingMovesFurtherInAPyramid) { expect_bounds(zoo::lattice_pile(3, 0.5), 100, 1); }

TEST(Sensitivity, NothingMovesFurtherInLattices) {
  expect_bounds(zoo::lattice_pile(4, 0.6), 20, 2);
  expect_bounds(zoo::column(6, 0.5, 0.3), 20, 3);
}

TEST(Sensitivity, NothingMovesFurtherWhereForcesAreUnbounded) {
  for (const Packing& packing : {zoo::wedge(1.4, 0.3), zoo::pinched_disk(0.5), zoo::corner(1.2, 1.5),
                                 zoo::two_wedges(1.4, 0.3, 0.5, 0.3), zoo::row_between_walls(4, 0.3),
                                 zoo::column_between_walls(3, 0.4)})
    expect_bounds(packing, 20, 4);
}

TEST(Sensitivity, NothingMovesFurtherWhereContactsAreClosed) {
  for (const Packing& packing : {zoo::corner(0.4, 0.5), zoo::corner(0.4, 1), zoo::wedge_and_corner(0.4, 0.3),
                                 zoo::pyramid(0.7, 0.9, 0.9), zoo::wedge_and_loose_disk(0.4, 0.3, 0),
                                 zoo::spun_wedge(0.5, 0.3, zoo::spun_wedge_critical_torque(0.5, 0.3))})
    expect_bounds(packing, 20, 5);
}

TEST(Sensitivity, NothingMovesFurtherInRandomPiles) {
  for (std::uint64_t seed = 200; seed < 204; ++seed)
    expect_bounds(zoo::random_pile(seed, 10, seed % 2 == 0 ? 0.5 : -1), 10, seed);
}

/// To first order a value is convex or concave along the turns, so that it moves furthest at a corner of the
/// cube of all turns.
TEST(Sensitivity, WhatIsExactIsReachedByTurningEachNormalToOneSideOrTheOther) {
  int exact = 0;
  for (const Packing& packing :
       {zoo::lattice_pile(2, 0.5), zoo::column(3, 0.5, 0.3), zoo::two_wedges(0.4, 0.3, 0.5, 0.2)}) {
    const ForceRanges ranges = analyze(packing);
    Table4<double> furthest = Table4<double>::Zero(packing.contact_count(), 4);
    for (unsigned corner = 0; corner < 1U << packing.contacts.size(); ++corner) {
      const ForceRanges after =
          analyze(turned(packing, [&](std::size_t i) { return (corner >> i & 1U) != 0 ? 1 : -1; }));
      furthest = furthest.max(moved(ranges, after));
    }
    EXPECT_EQ(further_than_stored(ranges, furthest), 0);
    for (Eigen::Index k = 0; k < furthest.size(); ++k) {
      if (!has_claim(ranges, k, SensitivityClaim::kExact)) continue;
      ++exact;
      EXPECT_NEAR(furthest.data()[k], ranges.sensitivity.value.data()[k], 1e-4) << k / 4 << ", " << k % 4;
    }
  }
  EXPECT_GT(exact, 30);
}

/// A pyramid of six disks: one of the motions that prove T_max of a contact between its disks tells 1.229,
/// but the value moves by 3.220.
TEST(Sensitivity, IsTheGreatestOfSeveralMotions) {
  const ForceRanges ranges = analyze(zoo::lattice_pile(3, 0.5));
  const auto is_near = [&](double value) {
    return ((ranges.sensitivity.value.col(kMaxT) - value).abs() < 1e-3).eval();
  };
  const auto is_exact =
      ranges.sensitivity.claim.col(kMaxT) == static_cast<std::uint8_t>(SensitivityClaim::kExact);
  EXPECT_TRUE((is_near(3.220) && is_exact).any());
  EXPECT_FALSE(is_near(1.229).any());
}

/// A disk that lies on the floor alone rolls off when that turns; the others stand as before.
TEST(Sensitivity, OfOthersIsFiniteBesideADiskThatMayRollOff) {
  const Packing alone = zoo::wedge(0.4, 0.3);
  Packing packing = alone;
  packing.disks.push_back(alone.disks.front());
  packing.disks.back().position.x() += 50;
  packing.disks.back().id = 77;
  Wall floor;
  floor.id = 78;
  floor.point = packing.disks.back().position - Vector2(0, 1);
  floor.normal = {0, 1};
  packing.walls.push_back(floor);
  Contact contact;
  contact.a = DiskId(1);
  contact.b = Body::wall(WallId(packing.wall_count() - 1));
  contact.normal = {0, 1};
  contact.mu = 0.3;
  packing.contacts.push_back(contact);
  const ForceRanges ranges = analyze(packing);
  EXPECT_TRUE(
      test::same_entries(analyze(alone).sensitivity.value, ranges.sensitivity.value.topRows(2), 1e-9));
  EXPECT_TRUE(ranges.sensitivity.value.isFinite().all());
  expect_bounds(packing, 20, 7);
}

TEST(Sensitivity, IsTheSameInAnyOrderOfDisksAndContacts) {
  Random random(6);
  for (const Packing& packing : {zoo::lattice_pile(3, 0.5), zoo::lattice_pile(4, 0.6),
                                 zoo::random_pile(102, 12, 0.5), zoo::two_wedges(0.4, 0.3, 0.5, 0.3)}) {
    const ForceRanges ranges = analyze(packing);
    for (int repeat = 0; repeat < 3; ++repeat) {
      const std::vector<int> disks = zoo::random_order(packing.disk_count(), random);
      const std::vector<int> contacts = zoo::random_order(packing.contact_count(), random);
      const ForceRanges expected = test::permuted(ranges, contacts);
      const ForceRanges found = analyze(zoo::permuted(packing, disks, contacts));
      EXPECT_TRUE(test::same_entries(expected.sensitivity.value, found.sensitivity.value, 1e-9));
      EXPECT_TRUE((expected.sensitivity.claim == found.sensitivity.claim).all());
    }
  }
}

}  // namespace
}  // namespace indet
