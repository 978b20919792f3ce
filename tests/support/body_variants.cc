#include "tests/support/body_variants.h"

#include <cmath>

#include "libindet/base/random.h"
#include "tests/support/scene_builder.h"
#include "tests/support/zoo.h"

namespace indet::zoo {

Packing with_levers(Packing packing, std::uint64_t seed) {
  Random random(seed, 1);
  for (Contact& contact : packing.contacts) {
    if (random.uniform() < 0.8) contact.lever_a = random.uniform(0.7, 1.2) * packing[contact.a].radius;
    if (!contact.b.is_wall() && random.uniform() < 0.8)
      contact.lever_b = random.uniform(0.7, 1.2) * packing[contact.b.disk_id()].radius;
  }
  return packing;
}

Packing with_fixed_disks(Packing packing, std::uint64_t seed) {
  Random random(seed, 2);
  for (std::size_t i = 1; i < packing.disks.size(); ++i) packing.disks[i].fixed = random.uniform() < 0.35;
  std::erase_if(packing.contacts, [&](const Contact& contact) {
    return !packing.has_equations(contact.a) && !packing.has_equations(contact.b);
  });
  return packing;
}

Packing disk_on_two_fixed(double phi, double mu, double left_radius, double right_radius) {
  Packing packing = empty_scene();
  const DiskId top = add_disk(packing, {0, 0});
  const auto add_fixed = [&](double side, double radius) {
    const double distance = 1 + radius;
    const DiskId disk =
        add_disk(packing, {side * distance * std::sin(phi), -distance * std::cos(phi)}, radius, 7);
    packing.disks.back().fixed = true;
    packing.disks.back().load = {3, 4, 5};
    touch(packing, top, Body::disk(disk), mu);
  };
  add_fixed(-1, left_radius);
  add_fixed(1, right_radius);
  return packing;
}

Packing wedge_with_levers(double phi, double mu, double lever_0, double lever_1) {
  Packing packing = wedge(phi, mu);
  packing.contacts[0].lever_a = lever_0;
  packing.contacts[1].lever_a = lever_1;
  return packing;
}

}  // namespace indet::zoo
