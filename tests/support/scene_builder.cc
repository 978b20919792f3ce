#include "tests/support/scene_builder.h"

namespace indet::zoo {

Packing empty_scene() {
  Packing packing;
  packing.gravity = {0, -1};
  return packing;
}

DiskId add_disk(Packing& packing, Vector2 position, double radius, double mass) {
  Disk disk;
  disk.id = packing.disk_count() + 1;
  disk.position = position;
  disk.radius = radius;
  disk.mass = mass;
  disk.inertia = mass * radius * radius / 2;
  packing.disks.push_back(disk);
  return DiskId(packing.disk_count() - 1);
}

WallId add_wall(Packing& packing, Vector2 point, Vector2 normal) {
  Wall wall;
  wall.id = packing.wall_count() + 1;
  wall.point = point;
  wall.normal = normal;
  packing.walls.push_back(wall);
  return WallId(packing.wall_count() - 1);
}

void touch(Packing& packing, DiskId a, Body b, double mu) {
  Contact contact;
  contact.a = a;
  contact.b = b;
  contact.normal = geometric_normal(packing, a, b);
  contact.gap = geometric_gap(packing, a, b);
  contact.mu = mu;
  packing.contacts.push_back(contact);
}

}  // namespace indet::zoo
