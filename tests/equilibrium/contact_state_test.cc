#include "libindet/equilibrium/contact_state.h"

#include <gtest/gtest.h>

#include "libindet/base/random.h"
#include "tests/support/body_variants.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

TEST(ContactState, ResidualIsTheOneOfThePapersEquations) {
  Random random(5);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Packing packing = zoo::rescaled(zoo::random_pile(seed, 6, -1), 0.37, 1.9, 9.81);
    packing.disks[2].load = {0.3, -2, 0.7};
    if (seed % 2 == 1) packing = zoo::with_levers(zoo::with_fixed_disks(packing, seed), seed);
    Eigen::VectorXd forces(2 * packing.contact_count());
    for (double& force : forces) force = random.uniform(-3, 3) * packing.force_unit();
    const Eigen::VectorXd balance =
        oracle::paper_matrix(packing) * forces / packing.force_unit() + oracle::paper_wrench(packing);
    const auto residual = equilibrium_residual(packing, SceneForces(forces));
    for (int i = 0; i < packing.disk_count(); ++i) {
      EXPECT_NEAR(residual(i, 0), balance[3 * i], 1e-13);
      EXPECT_NEAR(residual(i, 1), balance[3 * i + 1], 1e-13);
      EXPECT_NEAR(residual(i, 2), balance[3 * i + 2] / packing[DiskId(i)].radius, 1e-13);
    }
  }
}

TEST(ContactState, CoulombCountSortsContacts) {
  Packing packing = zoo::column(3, 0.5, 0.5);  // 6 contacts
  packing.contacts[5].mu = 0;
  packing.gravity = {0, -2};  // force unit 2: forces below are halved
  Eigen::VectorXd forces(12);
  forces << 2, 0.4,  // sticks
      2, -1,         // slides
      1e-12, 0,      // transmits nothing
      -0.2, 0,       // pulls
      2, 1.2,        // beyond friction by 0.2
      2, 0;          // frictionless: always "slides", not counted
  const CoulombCount count = count_coulomb(packing, SceneForces(forces), 1e-9);
  EXPECT_EQ(count.non_transmitting, 1);
  EXPECT_EQ(count.violated, 2);
  EXPECT_NEAR(count.worst_violation, 0.1, 1e-15);
  EXPECT_EQ(count.sliding, 1 + 2 + 2);  // slides, nothing (twice), and the two violated ones
}

}  // namespace
}  // namespace indet
