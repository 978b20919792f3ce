#include "tests/support/body_variants.h"

#include <array>
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

Packing with_loaded_walls(Packing packing, std::uint64_t seed) {
  Random random(seed, 3);
  for (Wall& wall : packing.walls) {
    if (random.uniform() < 0.7) wall.load_n = random.uniform(0, 3);
    if (random.uniform() < 0.4) wall.load_t = random.uniform(-0.1, 0.1);
  }
  std::erase_if(packing.contacts, [&](const Contact& contact) {
    return !packing.has_equations(contact.a) && !packing.has_equations(contact.b);
  });
  return packing;
}

Packing disks_between_plates(int count, double load, double mu) {
  Packing packing = empty_scene();
  const Body floor = Body::wall(add_wall(packing, {0, 0}, {0, 1}));
  const WallId plate = add_wall(packing, {0, 2}, {0, -1});
  packing.walls[1].load_n = load;
  for (int i = 0; i < count; ++i) add_disk(packing, {3.0 * i, 1});
  for (int i = 0; i < count; ++i) touch(packing, DiskId(i), floor, mu);
  for (int i = 0; i < count; ++i) touch(packing, DiskId(i), Body::wall(plate), mu);
  return packing;
}

Packing biaxial_box(int columns, int rows, double from_right, double from_above, double mu) {
  Packing packing;
  packing.named_force_unit = 1;
  const auto wall = [&](Vector2 point, Vector2 normal) {
    return Body::wall(add_wall(packing, point, normal));
  };
  const Body left = wall({0, 0}, {1, 0});
  const Body below = wall({0, 0}, {0, 1});
  const Body right = wall({2.0 * columns, 0}, {-1, 0});
  const Body above = wall({0, 2.0 * rows}, {0, -1});
  packing.walls[2].load_n = from_right;
  packing.walls[3].load_n = from_above;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) add_disk(packing, {2.0 * i + 1, 2.0 * j + 1});
  }
  const auto disk = [&](int i, int j) { return DiskId(j * columns + i); };
  for (int j = 0; j < rows; ++j) {
    touch(packing, disk(0, j), left, mu);
    for (int i = 0; i + 1 < columns; ++i) touch(packing, disk(i + 1, j), Body::disk(disk(i, j)), mu);
    touch(packing, disk(columns - 1, j), right, mu);
  }
  for (int i = 0; i < columns; ++i) {
    touch(packing, disk(i, 0), below, mu);
    for (int j = 0; j + 1 < rows; ++j) touch(packing, disk(i, j + 1), Body::disk(disk(i, j)), mu);
    touch(packing, disk(i, rows - 1), above, mu);
  }
  return packing;
}

Packing rack(double load) {
  Packing packing;
  packing.named_force_unit = 1;
  const double height = std::sqrt(3.0);
  add_disk(packing, {-1, 0});
  add_disk(packing, {1, 0});
  add_disk(packing, {0, height});
  // Each wall touches two disks, and its normal points to the third.
  const std::array<std::array<int, 3>, 3> sides = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};
  for (const auto& [first, second, opposite] : sides) {
    const Vector2 middle = (packing[DiskId(first)].position + packing[DiskId(second)].position) / 2;
    const Vector2 normal = (packing[DiskId(opposite)].position - middle).normalized();
    const Body wall = Body::wall(add_wall(packing, middle - normal, normal));
    packing.walls.back().load_n = load;
    touch(packing, DiskId(first), wall, 0);
    touch(packing, DiskId(second), wall, 0);
    touch(packing, DiskId(first), Body::disk(DiskId(second)), 0);
  }
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
