#include "libindet/limit/load_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/limit/bracket.h"
#include "tests/support/body_variants.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

Loads on_disk(const Packing& packing, int disk, const Vector3& load) {
  Loads loads;
  loads.disks.assign(packing.disks.size(), Vector3::Zero());
  loads.disks[static_cast<std::size_t>(disk)] = load;
  return loads;
}

TEST(LoadLimits, TorqueThatADiskInAGrooveCanBear) {
  const double phi = 1.1;
  const double mu = 0.3;
  const Packing packing = zoo::spun_wedge(phi, mu, 0);
  const LoadLimits limits = find_load_limits(packing, on_disk(packing, 0, {0, 0, 1}));
  const double critical = zoo::spun_wedge_critical_torque(phi, mu);
  EXPECT_NEAR(limits.largest.value, critical, 1e-12 * critical);
  EXPECT_NEAR(limits.smallest.value, -critical, 1e-12 * critical);
  EXPECT_EQ(limits.largest.sliding, 2);
  EXPECT_EQ(limits.largest.dim, 0);
  EXPECT_TRUE(limits.largest.has_one_mechanism);
  EXPECT_TRUE(limits.stands());
}

TEST(LoadLimits, WeightTakenOffADiskOnAFloor) {
  const Packing packing = zoo::disk_on_floor(0.3);
  const LoadLimits limits = find_load_limits(packing, on_disk(packing, 0, {0, 1, 0}));
  EXPECT_EQ(limits.largest.value, 1);
  EXPECT_EQ(limits.largest.lower, 1);
  EXPECT_EQ(limits.largest.upper, 1);
  EXPECT_EQ(limits.smallest.outcome, LimitOutcome::kNever);
  EXPECT_EQ(limits.smallest.forces.value()[0], 1);  // the ray: the floor bears what is added
}

TEST(LoadLimits, OfWhatCannotStandAsItIs) {
  // On an incline a disk rolls; a torque holds it: r sin(0.1) m g.
  const Packing packing = zoo::disk_on_incline(0.1, 1);
  const LoadLimits limits = find_load_limits(packing, on_disk(packing, 0, {0, 0, 1}));
  EXPECT_FALSE(limits.stands());
  EXPECT_NEAR(std::abs(limits.largest.value), std::sin(0.1), 1e-12);
  EXPECT_EQ(limits.largest.value, limits.smallest.value);
  // No multiple of a force across it helps.
  const LoadLimits none = find_load_limits(
      packing, on_disk(packing, 0, {packing.contacts[0].normal.x(), packing.contacts[0].normal.y(), 0}));
  EXPECT_EQ(none.largest.outcome, LimitOutcome::kNoState);
  EXPECT_EQ(none.smallest.outcome, LimitOutcome::kNoState);
  EXPECT_EQ(none.largest.motion.disks.rows(), 1);
}

TEST(LoadLimits, NoStateAtAllIsNotNever) {
  // Nothing takes the horizontal load, however small it is, though any weight is borne.
  Packing packing = zoo::disk_on_floor(0);
  packing.disks[0].load.x() = 1e-13;
  const LoadLimits limits = find_load_limits(packing, on_disk(packing, 0, {0, -1, 0}));
  EXPECT_EQ(limits.largest.outcome, LimitOutcome::kNoState);
  EXPECT_EQ(limits.smallest.outcome, LimitOutcome::kNoState);
}

TEST(LoadLimits, ShearOfAFrictionlessTriangularLatticeAtFixedPressure) {
  // Σ f l lᵀ over bonds along 0°, 60°, 120°: σ_yy ∝ ¾ (f_60 + f_120), σ_xy ∝ ¼√3 (f_60 − f_120), so that
  // σ_xy ≤ σ_yy / √3, with σ_xx = f_0 + σ_yy / 3.
  Packing packing = zoo::periodic_lattice(3, 4, 0, 0);
  packing.stress.xx = packing.stress.yy = 1;
  packing.stress.xy = 0;
  Loads shear;
  shear.stress[2] = 1;
  const LoadLimits limits = find_load_limits(packing, shear);
  EXPECT_NEAR(limits.largest.value, 1 / std::sqrt(3), 1e-12);
  EXPECT_NEAR(limits.smallest.value, -1 / std::sqrt(3), 1e-12);
  EXPECT_EQ(limits.largest.motion.cell.rows(), 2);
}

TEST(LoadLimits, OfPilesAreWhereTheyFallByExactArithmetic) {
  int reached = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}) {
    Packing packing = zoo::random_pile(seed, 6, 0.6);
    if (seed % 2 == 0) packing = zoo::with_loaded_walls(packing, seed);
    if (seed % 3 == 0) packing = zoo::with_fixed_disks(packing, seed);
    if (seed % 5 == 0) packing = zoo::with_levers(packing, seed);
    for (const Vector3& load : {Vector3(1, 0.3, 0), Vector3(0.1, 0.7, 0.5)}) {
      int disk = packing.disk_count() - 1;
      while (packing.disks[static_cast<std::size_t>(disk)].fixed) --disk;
      const Loads change = on_disk(packing, disk, load);
      const LoadLimits limits = find_load_limits(packing, change);
      EXPECT_EQ(limits.stands(), test::stands(packing)) << seed;
      const auto at = [&](double lambda) { return under(change, lambda, packing); };
      for (const auto& [end, sign] : {std::pair(&limits.largest, 1), std::pair(&limits.smallest, -1)}) {
        if (end->outcome == LimitOutcome::kReached) {
          // Where both ends are one value, it stands nowhere else.
          if (limits.largest.value - limits.smallest.value < 1e-6) continue;
          test::expect_end(*end, sign, at, 1e-9);
          ++reached;
        } else if (end->outcome == LimitOutcome::kNever) {
          EXPECT_TRUE(test::stands(at(sign * 1e6))) << seed;
        } else {
          EXPECT_EQ(end->outcome, LimitOutcome::kNoState) << seed;
        }
      }
    }
  }
  EXPECT_GE(reached, 10);
}

}  // namespace
}  // namespace indet
