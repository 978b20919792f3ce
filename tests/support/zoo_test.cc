#include "tests/support/zoo.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libindet/packing/validate.h"

namespace indet {
namespace {

std::string defect(const Packing& packing) {
  const auto found = find_defect(packing);
  return found ? found->reason : "";
}

TEST(Zoo, EveryPackingIsValidAndItsContactsTouch) {
  std::vector<Packing> all = {zoo::wedge(0.4, 0.3),
                              zoo::disk_on_floor(0.3),
                              zoo::disk_on_incline(0.2, 0.3),
                              zoo::pyramid(0.8, 0.5, 0.5),
                              zoo::frictionless_column(5, 0.6),
                              zoo::column(5, 0.6, 0.3),
                              zoo::pinched_disk(0.3),
                              zoo::two_wedges(0.4, 0.3, 0.5, 0.2),
                              zoo::corner(0.3, 0.5),
                              zoo::spun_wedge(0.6, 0.3, 0.1),
                              zoo::wedge_and_corner(0.4, 0.3),
                              zoo::wedge_and_loose_disk(0.4, 0.3, 1),
                              zoo::lattice_pile(4, 0.3)};
  for (std::uint64_t seed = 0; seed < 20; ++seed) all.push_back(zoo::random_pile(seed, 8, -1));
  for (const Packing& packing : all) {
    for (const Packing& seen : {packing, zoo::mirrored(packing), zoo::rotated(packing, 0.7),
                                zoo::rescaled(packing, 2, 3, 5), zoo::with_bodies_swapped(packing)}) {
      EXPECT_EQ(defect(seen), "");
      for (const Contact& contact : seen.contacts)
        EXPECT_NEAR(geometric_gap(seen, contact.a, contact.b), 0, 1e-12 * seen.max_radius() * 100);
    }
  }
}

TEST(Zoo, RandomPilesDoNotOverlap) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Packing packing = zoo::random_pile(seed, 8, 0.3);
    EXPECT_EQ(packing.contact_count(), 16);
    for (int i = 0; i < packing.disk_count(); ++i) {
      for (int j = 0; j < i; ++j) EXPECT_GT(geometric_gap(packing, DiskId(i), Body::disk(DiskId(j))), -1e-12);
      for (int w = 0; w < packing.wall_count(); ++w)
        EXPECT_GT(geometric_gap(packing, DiskId(i), Body::wall(WallId(w))), -1e-12);
    }
  }
}

TEST(Zoo, SeedsGiveDifferentPiles) {
  EXPECT_NE(zoo::random_pile(1, 4, 0.3).disks[0].radius, zoo::random_pile(2, 4, 0.3).disks[0].radius);
}

}  // namespace
}  // namespace indet
