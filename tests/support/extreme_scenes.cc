#include <cmath>
#include <numbers>

#include "libindet/base/random.h"
#include "tests/support/extremes.h"
#include "tests/support/scene_builder.h"
#include "tests/support/zoo.h"

namespace indet::extremes {
namespace {

using zoo::add_disk;
using zoo::add_wall;
using zoo::column;
using zoo::empty_scene;
using zoo::touch;

std::string power_name(const char* what, int exponent) {
  return std::string(what) + "1e" + std::to_string(exponent);
}

/// Moves every centre by up to `size` and takes the normals from the new places.
Packing jittered(Packing packing, double size, std::uint64_t seed) {
  Random random(seed);
  for (Disk& disk : packing.disks) {
    disk.position.x() += random.uniform(-size, size);
    disk.position.y() += random.uniform(-size, size);
  }
  for (Contact& contact : packing.contacts) {
    contact.normal = geometric_normal(packing, contact.a, contact.b);
    contact.gap = geometric_gap(packing, contact.a, contact.b);
  }
  return packing;
}

void set_friction(Packing& packing, double mu) {
  for (Contact& contact : packing.contacts) contact.mu = mu;
}

/// columns × rows disks on a square lattice in a box.
Packing square_lattice(int columns, int rows, double mu) {
  Packing packing = empty_scene();
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  const WallId left = add_wall(packing, {-1, 0}, {1, 0});
  const WallId right = add_wall(packing, {2.0 * columns - 1, 0}, {-1, 0});
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < columns; ++k) {
      const DiskId disk = add_disk(packing, {2.0 * k, 2.0 * row + 1}, 1, 1);
      const auto below = row == 0 ? Body::wall(floor) : Body::disk(DiskId(disk.value() - columns));
      touch(packing, disk, below, mu);
      touch(packing, disk, k == 0 ? Body::wall(left) : Body::disk(DiskId(disk.value() - 1)), mu);
      if (k == columns - 1) touch(packing, disk, Body::wall(right), mu);
    }
  }
  return packing;
}

/// `count` disks on an arc between two walls that face its ends. Stands only where the arc is the line of
/// thrust, and every contact carries the torque: empty but for one disk or two.
Packing arch(int count, double half_angle, double mu) {
  Packing packing = empty_scene();
  const double step = 2 * half_angle / (count + 1);
  const double radius = 1 / std::sin(step / 2);
  const auto place = [&](int k) {
    const double angle = -half_angle + step * (k + 1);
    return Vector2(radius * std::sin(angle), radius * std::cos(angle));
  };
  for (int k = 0; k < count; ++k) add_disk(packing, place(k), 1, 1);
  for (const int end : {-1, count}) {
    const Vector2 normal = (place(end < 0 ? 0 : count - 1) - place(end)).normalized();
    const Vector2 contact = place(end) + normal;
    touch(packing, DiskId(end < 0 ? 0 : count - 1), Body::wall(add_wall(packing, contact, normal)), mu);
  }
  for (int k = 1; k < count; ++k) touch(packing, DiskId(k), Body::disk(DiskId(k - 1)), mu);
  return packing;
}

/// One disk on `count` walls whose normals fan out by `angle` from the vertical.
Packing fan(int count, double angle, double mu) {
  Packing packing = empty_scene();
  const DiskId disk = add_disk(packing, {0, 0}, 1, 1);
  for (int k = 0; k < count; ++k) {
    const double tilt = angle * (2 * k - count + 1);
    const Vector2 normal(std::sin(tilt), std::cos(tilt));
    touch(packing, disk, Body::wall(add_wall(packing, -normal, normal)), mu);
  }
  return packing;
}

class Collection {
 public:
  void add(const std::string& kind, const std::string& name, Packing packing) {
    scenes_.push_back({kind, name, std::move(packing)});
  }
  std::vector<Scene> take() { return std::move(scenes_); }

 private:
  std::vector<Scene> scenes_;
};

void add_wedges(Collection& all) {
  for (const double mu : {0.1, 0.3, 1.0}) {
    const std::string friction = " mu " + std::to_string(mu);
    for (int k = 1; k <= 15; ++k)
      all.add("wedge, small angle", power_name("phi ", -k) + friction, zoo::wedge(std::pow(10.0, -k), mu));
    all.add("wedge, angle 0", "phi 0" + friction, zoo::wedge(0, mu));
    for (int k = 2; k <= 15; ++k) {
      for (const int side : {-1, 1}) {
        const double tangent = (1 + side * std::pow(10.0, -k)) / mu;
        all.add("wedge, critical friction", power_name(side < 0 ? "below by " : "above by ", -k) + friction,
                zoo::wedge(std::atan(tangent), mu));
      }
    }
  }
  for (int k = 2; k <= 15; k += 1) {
    for (const int count : {2, 3})
      all.add("nearly parallel contacts", power_name("fan ", -k) + " of " + std::to_string(count),
              fan(count, std::pow(10.0, -k), 0.3));
  }
}

void add_friction(Collection& all) {
  for (int k = -13; k <= 6; ++k) {
    const double mu = k == -13 ? 0 : std::pow(10.0, k);
    const std::string name = k == -13 ? "mu 0" : power_name("mu ", k);
    all.add("friction coefficient", "wedge " + name, zoo::wedge(0.5, mu));
    all.add("friction coefficient", "column " + name, column(3, 0.3, mu));
    all.add("friction coefficient", "pile " + name, zoo::random_pile(7, 3, mu));
  }
}

void add_ratios(Collection& all) {
  for (int k = -12; k <= 12; k += 2) {
    const double ratio = std::pow(10.0, k);
    Packing heavy = column(2, 0.3, 0.3);
    heavy.disks[1].mass *= ratio;
    all.add("mass ratio", power_name("upper disk ", k), heavy);
    Packing pair = zoo::two_wedges(0.4, 0.3, 0.6, 0.5);
    pair.disks[1].mass *= ratio;
    all.add("mass ratio", power_name("apart ", k), pair);
  }
  for (int k = -6; k <= 6; ++k) {
    const double radius = std::pow(10.0, k);
    Packing packing = empty_scene();
    const WallId floor = add_wall(packing, {0, 0}, {0, 1});
    const WallId left = add_wall(packing, {-1, 0}, {1, 0});
    const DiskId low = add_disk(packing, {0, 1}, 1, 1);
    // On the lower disk, and leaning on the left wall or standing beside it.
    const double x = radius - 1;
    const double reach = 1 + radius;
    const double height = reach * reach - x * x;
    const DiskId high = add_disk(packing, {x, 1 + std::sqrt(std::max(0.0, height))}, radius, radius * radius);
    touch(packing, low, Body::wall(floor), 0.4);
    touch(packing, low, Body::wall(left), 0.4);
    touch(packing, high, Body::disk(low), 0.4);
    touch(packing, high, Body::wall(left), 0.4);
    all.add("radius ratio", power_name("upper disk ", k), packing);
    // On the floor both, the unit disk at the left wall, the other one beside it and at a right wall.
    Packing row = empty_scene();
    const WallId ground = add_wall(row, {0, 0}, {0, 1});
    const WallId west = add_wall(row, {-1, 0}, {1, 0});
    const double distance = 2 * std::sqrt(radius);
    const WallId east = add_wall(row, {distance + radius, 0}, {-1, 0});
    const DiskId unit = add_disk(row, {0, 1}, 1, 1);
    const DiskId other = add_disk(row, {distance, radius}, radius, radius * radius);
    touch(row, unit, Body::wall(ground), 0.4);
    touch(row, unit, Body::wall(west), 0.4);
    touch(row, other, Body::disk(unit), 0.4);
    touch(row, other, Body::wall(ground), 0.4);
    touch(row, other, Body::wall(east), 0.4);
    all.add("radius ratio", power_name("beside each other ", k), row);
  }
  for (const int k : {-100, -12, 12, 100}) {
    const double factor = std::pow(10.0, k);
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Packing pile = zoo::random_pile(seed, 3, 0.4);
      const std::string number = " pile " + std::to_string(seed);
      all.add("units", power_name("gravity ", k) + number, zoo::rescaled(pile, 1, 1, factor));
      all.add("units", power_name("length ", k) + number, zoo::rescaled(pile, factor, 1, 1));
      Packing named = pile;
      named.named_force_unit = factor;
      if (std::abs(k) == 12) all.add("units", power_name("named force unit ", k) + number, named);
    }
  }
}

void add_lattices(Collection& all) {
  for (int base = 2; base <= 3; ++base) {
    for (const double mu : {0.2, 0.3, 0.6}) {
      const std::string name = std::to_string(base) + " mu " + std::to_string(mu);
      all.add("triangular lattice", name, zoo::lattice_pile(base, mu));
      for (int k = 3; k <= 15; k += 3)
        all.add("lattice with jitter", name + power_name(" triangular ", -k),
                jittered(zoo::lattice_pile(base, mu), std::pow(10.0, -k), 5));
    }
  }
  for (const double mu : {0.0, 0.3}) {
    for (int rows = 1; rows <= 2; ++rows) {
      const std::string name = "2 x " + std::to_string(rows) + " mu " + std::to_string(mu);
      all.add("square lattice", name, square_lattice(2, rows, mu));
      for (int k = 3; k <= 15; k += 3)
        all.add("lattice with jitter", name + power_name(" square ", -k),
                jittered(square_lattice(2, rows, mu), std::pow(10.0, -k), 6));
    }
  }
}

void add_structures(Collection& all) {
  for (const int count : {1, 2, 3, 4, 5}) {
    all.add("column", std::to_string(count) + " smooth", zoo::frictionless_column(count, 0.4));
    all.add("column", std::to_string(count) + " rough", column(count, 0.4, 0.3));
    all.add("column", std::to_string(count) + " rough, upright", column(count, 0.0, 0.3));
  }
  for (int count = 1; count <= 4; ++count) {
    for (const double mu : {0.1, 0.5, 1.2}) {
      all.add("arch", std::to_string(count) + " disks, mu " + std::to_string(mu), arch(count, 1.2, mu));
      all.add("arch", std::to_string(count) + " disks, flat, mu " + std::to_string(mu), arch(count, 0.3, mu));
    }
  }
  for (const double mu : {0.3, 0.9, 1.0, 1.1}) {
    for (const double wall : {0.5, 1.0, 1.5})
      all.add("must slide", "corner " + std::to_string(mu) + " " + std::to_string(wall),
              zoo::corner(mu, wall));
  }
  const double critical = zoo::spun_wedge_critical_torque(0.6, 0.3);
  all.add("must slide", "spun wedge, critical", zoo::spun_wedge(0.6, 0.3, critical));
  for (int k = 2; k <= 15; ++k) {
    for (const int side : {-1, 1}) {
      const double off = 1 + side * std::pow(10.0, -k);
      const std::string name = power_name(side < 0 ? "below by " : "above by ", -k);
      all.add("empty or not by a hair", "spun wedge " + name, zoo::spun_wedge(0.6, 0.3, critical * off));
      const double mu = std::tan(0.35);
      all.add("empty or not by a hair", "pyramid " + name, zoo::pyramid(0.7, mu * off, mu));
      all.add("empty or not by a hair", "pyramid on floor " + name, zoo::pyramid(0.7, mu * 2, mu / 3 * off));
    }
  }
  all.add("clusters", "two wedges", zoo::two_wedges(0.3, 0.3, 0.5, 0.2));
  all.add("clusters", "two wedges, one jammed", zoo::two_wedges(0.3, 0.3, 1.3, 0.5));
  all.add("clusters", "wedge and corner", zoo::wedge_and_corner(0.3, 0.3));
  all.add("clusters", "wedge and loose disk", zoo::wedge_and_loose_disk(0.3, 0.3, 0));
  all.add("clusters", "wedge and falling disk", zoo::wedge_and_loose_disk(0.3, 0.3, 1e-3));
}

void add_walls(Collection& all) {
  for (const double mu : {0.0, 0.3}) {
    Packing twice = zoo::disk_on_floor(mu);
    touch(twice, DiskId(0), Body::wall(add_wall(twice, {0, 0}, {0, 1})), mu);
    all.add("redundant walls", "floor twice, mu " + std::to_string(mu), twice);
    touch(twice, DiskId(0), Body::wall(add_wall(twice, {0, 2}, {0, -1})), mu);
    all.add("redundant walls", "and a ceiling, mu " + std::to_string(mu), twice);
    all.add("redundant walls", "pinched, mu " + std::to_string(mu), zoo::pinched_disk(mu));
    for (int k = 3; k <= 15; k += 3) {
      Packing tilted = zoo::disk_on_floor(mu);
      const double angle = std::pow(10.0, -k);
      const Vector2 normal(std::sin(angle), std::cos(angle));
      touch(tilted, DiskId(0), Body::wall(add_wall(tilted, Vector2(0, 1) - normal, normal)), mu);
      all.add("redundant walls", power_name("floor tilted by ", -k), tilted);
    }
  }
  for (const double angle : {0.1, 0.3, 0.7, 1.0, 1.5}) {
    for (const double mu : {0.0, 0.3}) {
      all.add("turned", "disk on floor by " + std::to_string(angle),
              zoo::rotated(zoo::disk_on_floor(mu), angle));
      all.add("turned", "pinched by " + std::to_string(angle), zoo::rotated(zoo::pinched_disk(mu), angle));
      all.add("turned", "corner by " + std::to_string(angle), zoo::rotated(zoo::corner(mu, 0.5), angle));
      all.add("turned", "square lattice by " + std::to_string(angle),
              zoo::rotated(square_lattice(2, 1, mu), angle));
    }
  }
}

void add_trifles(Collection& all) {
  Packing nothing;
  nothing.gravity = {0, -1};
  all.add("next to nothing", "no disk", nothing);
  Packing falling = nothing;
  add_disk(falling, {0, 0}, 1, 1);
  all.add("next to nothing", "one disk, no contact", falling);
  Packing floating = falling;
  floating.gravity = {0, 0};
  floating.named_force_unit = 1;
  all.add("next to nothing", "one disk, no load", floating);
  for (const double mu : {0.0, 0.3}) {
    all.add("next to nothing", "disk on floor", zoo::disk_on_floor(mu));
    all.add("next to nothing", "disk on incline", zoo::disk_on_incline(0.1, mu));
    for (int k = 3; k <= 15; k += 3)
      all.add("next to nothing", power_name("disk on incline ", -k),
              zoo::disk_on_incline(std::pow(10.0, -k), mu));
  }
  all.add("next to nothing", "pyramid", zoo::pyramid(0.7, 0.5, 0.5));
}

}  // namespace

std::vector<Scene> fixed_scenes() {
  Collection all;
  add_wedges(all);
  add_friction(all);
  add_ratios(all);
  add_lattices(all);
  add_structures(all);
  add_walls(all);
  add_trifles(all);
  return all.take();
}

Scene random_scene(std::uint64_t seed, int most) {
  Random random(seed + 1);
  const int count = 1 + static_cast<int>(random.uniform(0, most));
  const auto decade = [&](double low, double high) { return std::pow(10.0, random.uniform(low, high)); };
  constexpr double kFrictions[] = {-1, 0, 0.05, 0.3, 0.7, 2};
  const double mu = kFrictions[static_cast<int>(random.uniform(0, 6))];
  Scene scene{"random", "seed " + std::to_string(seed), zoo::random_pile(seed, count, mu)};
  Packing& packing = scene.packing;
  switch (static_cast<int>(random.uniform(0, 9))) {
    case 0:
      scene.kind = "random: as it is";
      break;
    case 1:
      scene.kind = "random: friction";
      set_friction(packing, decade(-12, 6));
      break;
    case 2:
      scene.kind = "random: friction of each";
      for (Contact& contact : packing.contacts) contact.mu = decade(-12, 6);
      break;
    case 3:
      scene.kind = "random: masses";
      for (Disk& disk : packing.disks) disk.mass *= decade(-6, 6);
      break;
    case 4: {
      scene.kind = "random: wall twice, off by a hair";
      const double angle = random.uniform(0, 1) < 0.2 ? 0 : decade(-16, -2);
      // A wall beside the one of some contact: the validation refuses the same two bodies twice.
      for (const Contact& contact : packing.contacts) {
        if (!contact.b.is_wall()) continue;
        const Vector2 normal = (contact.normal + angle * contact.tangent()).normalized();
        const DiskId disk = contact.a;
        const double friction = contact.mu;
        const WallId wall = add_wall(packing, packing[disk].position - packing[disk].radius * normal, normal);
        touch(packing, disk, Body::wall(wall), friction);
        break;
      }
      break;
    }
    case 5:
      scene.kind = "random: turned";
      packing = zoo::rotated(packing, random.uniform(0, 6.28));
      break;
    case 6:
      scene.kind = "random: units";
      packing = zoo::rescaled(packing, decade(-60, 60), decade(-40, 40), decade(-40, 40));
      break;
    case 7:
      scene.kind = "random: torques";
      for (Disk& disk : packing.disks) disk.load.z() = random.uniform(-1, 1) * decade(-12, 0);
      break;
    default:
      scene.kind = "random: contacts taken away";
      while (packing.contacts.size() > packing.disks.size() && random.uniform(0, 1) < 0.6) {
        const auto gone =
            static_cast<std::ptrdiff_t>(random.uniform(0, static_cast<double>(packing.contacts.size())));
        packing.contacts.erase(packing.contacts.begin() + gone);
      }
      break;
  }
  return scene;
}

}  // namespace indet::extremes
