#include "tests/support/zoo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "libindet/base/random.h"
#include "tests/support/scene_builder.h"

namespace indet::zoo {
namespace {

/// A disk at `centre` in a groove of its own.
void add_wedge(Packing& packing, Vector2 centre, double phi, double mu) {
  const DiskId disk = add_disk(packing, centre);
  for (const double side : {1.0, -1.0}) {
    const Vector2 normal(side * std::sin(phi), std::cos(phi));
    touch(packing, disk, Body::wall(add_wall(packing, centre - normal, normal)), mu);
  }
}

void add_corner(Packing& packing, Vector2 centre, double mu_floor, double mu_wall) {
  const DiskId disk = add_disk(packing, centre);
  touch(packing, disk, Body::wall(add_wall(packing, centre - Vector2(0, 1), {0, 1})), mu_floor);
  touch(packing, disk, Body::wall(add_wall(packing, centre - Vector2(1, 0), {1, 0})), mu_wall);
}

}  // namespace

Packing wedge(double phi, double mu) {
  Packing packing = empty_scene();
  add_wedge(packing, {0, 0}, phi, mu);
  return packing;
}

WedgeRanges wedge_ranges(double phi, double mu) {
  const double s = std::sin(phi);
  const double c = std::cos(phi);
  WedgeRanges ranges{};
  ranges.R_min = 0.5 / (c + mu * s);
  ranges.R_max = 0.5 / (c - mu * s);
  ranges.T_min = -mu * ranges.R_min;
  ranges.T_max = mu * ranges.R_max;
  const double denominator = (c - mu * s) * (c + mu * s);
  ranges.delta_R = mu * s / denominator;
  ranges.delta_T = mu * c / denominator;
  return ranges;
}

Packing disk_on_floor(double mu) {
  Packing packing = empty_scene();
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  touch(packing, add_disk(packing, {0, 1}), Body::wall(floor), mu);
  return packing;
}

Packing disk_on_incline(double angle, double mu) {
  Packing packing = empty_scene();
  const Vector2 normal(std::sin(angle), std::cos(angle));
  const WallId plane = add_wall(packing, {0, 0}, normal);
  touch(packing, add_disk(packing, normal), Body::wall(plane), mu);
  return packing;
}

Packing pyramid(double theta, double mu_upper, double mu_floor) {
  Packing packing = empty_scene();
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  const double half_gap = 2 * std::sin(theta);
  const DiskId left = add_disk(packing, {-half_gap, 1});
  const DiskId right = add_disk(packing, {half_gap, 1});
  const DiskId top = add_disk(packing, {0, 1 + 2 * std::cos(theta)});
  touch(packing, top, Body::disk(left), mu_upper);
  touch(packing, top, Body::disk(right), mu_upper);
  touch(packing, left, Body::wall(floor), mu_floor);
  touch(packing, right, Body::wall(floor), mu_floor);
  return packing;
}

Packing frictionless_column(int count, double theta) { return column(count, theta, 0); }

Packing column(int count, double theta, double mu) {
  Packing packing = empty_scene();
  const double shift = 2 * std::sin(theta);
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  const WallId left = add_wall(packing, {-1, 0}, {1, 0});
  const WallId right = add_wall(packing, {shift + 1, 0}, {-1, 0});
  for (int k = 0; k < count; ++k) add_disk(packing, {k % 2 == 0 ? 0 : shift, 1 + 2 * k * std::cos(theta)});
  touch(packing, DiskId(0), Body::wall(floor), mu);
  for (int k = 1; k < count; ++k) touch(packing, DiskId(k), Body::disk(DiskId(k - 1)), mu);
  for (int k = 0; k < count; ++k) touch(packing, DiskId(k), Body::wall(k % 2 == 0 ? left : right), mu);
  return packing;
}

Packing column_between_walls(int count, double mu) {
  Packing packing = empty_scene();
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  const WallId left = add_wall(packing, {-1, 0}, {1, 0});
  const WallId right = add_wall(packing, {1, 0}, {-1, 0});
  for (int k = 0; k < count; ++k) {
    const DiskId disk = add_disk(packing, {0, 1 + 2.0 * k});
    touch(packing, disk, k == 0 ? Body::wall(floor) : Body::disk(DiskId(k - 1)), mu);
    touch(packing, disk, Body::wall(left), mu);
    touch(packing, disk, Body::wall(right), mu);
  }
  return packing;
}

Packing row_between_walls(int count, double mu) {
  Packing packing = empty_scene();
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  for (int k = 0; k < count; ++k) touch(packing, add_disk(packing, {2.0 * k, 1}), Body::wall(floor), mu);
  for (int k = 1; k < count; ++k) touch(packing, DiskId(k), Body::disk(DiskId(k - 1)), mu);
  touch(packing, DiskId(0), Body::wall(add_wall(packing, {-1, 0}, {1, 0})), mu);
  touch(packing, DiskId(count - 1), Body::wall(add_wall(packing, {2.0 * count - 1, 0}, {-1, 0})), mu);
  return packing;
}

Packing pinched_disk(double mu) {
  Packing packing = empty_scene();
  const DiskId disk = add_disk(packing, {0, 0});
  touch(packing, disk, Body::wall(add_wall(packing, {-1, 0}, {1, 0})), mu);
  touch(packing, disk, Body::wall(add_wall(packing, {1, 0}, {-1, 0})), mu);
  return packing;
}

Packing two_wedges(double phi_left, double mu_left, double phi_right, double mu_right) {
  Packing packing = empty_scene();
  add_wedge(packing, {-10, 0}, phi_left, mu_left);
  add_wedge(packing, {10, 0}, phi_right, mu_right);
  return packing;
}

Packing corner(double mu_floor, double mu_wall) {
  Packing packing = empty_scene();
  add_corner(packing, {0, 0}, mu_floor, mu_wall);
  return packing;
}

Packing spun_wedge(double phi, double mu, double torque) {
  Packing packing = wedge(phi, mu);
  packing.disks[0].load.z() = torque;
  return packing;
}

double spun_wedge_critical_torque(double phi, double mu) { return mu / (std::cos(phi) * (1 + mu * mu)); }

Packing wedge_and_corner(double phi, double mu) {
  Packing packing = wedge(phi, mu);
  add_corner(packing, {20, 0}, 0.3, 0.5);
  return packing;
}

Packing wedge_and_loose_disk(double phi, double mu, double loose_load) {
  Packing packing = wedge(phi, mu);
  packing.gravity = {0, 0};
  packing.named_force_unit = 1;
  packing.disks[0].load.y() = -1;
  add_disk(packing, {20, 0});
  packing.disks[1].load.x() = loose_load;
  return packing;
}

Packing lattice_pile(int base, double mu) {
  Packing packing = empty_scene();
  const WallId floor = add_wall(packing, {0, 0}, {0, 1});
  std::vector<int> below;
  for (int row = 0; row < base; ++row) {
    std::vector<int> present;
    for (int k = 0; k < base - row; ++k) {
      present.push_back(packing.disk_count());
      const DiskId disk = add_disk(packing, {2.0 * k + row, 1 + row * std::numbers::sqrt3});
      if (k > 0) touch(packing, disk, Body::disk(DiskId(disk.value() - 1)), mu);
      if (row == 0) {
        touch(packing, disk, Body::wall(floor), mu);
        continue;
      }
      for (const int offset : {0, 1})
        touch(packing, disk, Body::disk(DiskId(below[static_cast<std::size_t>(k + offset)])), mu);
    }
    below = std::move(present);
  }
  return packing;
}

Packing lattice_between_walls(int base, double mu) {
  Packing packing = lattice_pile(base, mu);
  touch(packing, DiskId(0), Body::wall(add_wall(packing, {-1, 0}, {1, 0})), mu);
  touch(packing, DiskId(base - 1), Body::wall(add_wall(packing, {2.0 * base - 1, 0}, {-1, 0})), mu);
  return packing;
}

namespace {

/// A body as the set of centres of disks of a given radius that touch it: a circle or a line.
struct Locus {
  Body body;
  bool is_line = false;
  Vector2 centre{0, 0};  ///< of the circle, or a point of the line
  Vector2 along{0, 0};   ///< of the line
  double radius = 0;
};

std::vector<Vector2> line_with_circle(const Locus& line, const Locus& circle) {
  const Vector2 offset = line.centre - circle.centre;
  const double b = offset.dot(line.along);
  const double discriminant = b * b - offset.squaredNorm() + circle.radius * circle.radius;
  if (discriminant < 1e-6) return {};
  const double root = std::sqrt(discriminant);
  return {line.centre + (-b - root) * line.along, line.centre + (-b + root) * line.along};
}

std::vector<Vector2> intersections(const Locus& first, const Locus& second) {
  if (first.is_line && second.is_line) {
    const double determinant = first.along.x() * second.along.y() - first.along.y() * second.along.x();
    if (std::abs(determinant) < 1e-6) return {};
    const Vector2 offset = second.centre - first.centre;
    const double s = (offset.x() * second.along.y() - offset.y() * second.along.x()) / determinant;
    return {first.centre + s * first.along};
  }
  if (first.is_line) return line_with_circle(first, second);
  if (second.is_line) return line_with_circle(second, first);
  const Vector2 offset = second.centre - first.centre;
  const double distance = offset.norm();
  if (distance < 1e-6) return {};
  const double along =
      (distance * distance + first.radius * first.radius - second.radius * second.radius) / (2 * distance);
  const double squared = first.radius * first.radius - along * along;
  if (squared < 1e-6) return {};
  const Vector2 axis = offset / distance;
  const Vector2 side(-axis.y(), axis.x());
  const Vector2 foot = first.centre + along * axis;
  return {foot + std::sqrt(squared) * side, foot - std::sqrt(squared) * side};
}

struct Place {
  Vector2 centre;
  Body first, second;
};

/// Where a disk of this radius touches two bodies, rests on them, and overlaps nothing.
std::vector<Place> resting_places(const Packing& packing, double radius) {
  std::vector<Locus> loci;
  for (int w = 0; w < packing.wall_count(); ++w) {
    const Wall& wall = packing[WallId(w)];
    loci.push_back({Body::wall(WallId(w)),
                    true,
                    wall.point + radius * wall.normal,
                    {wall.normal.y(), -wall.normal.x()},
                    0});
  }
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Disk& disk = packing[DiskId(i)];
    loci.push_back({Body::disk(DiskId(i)), false, disk.position, {0, 0}, disk.radius + radius});
  }
  std::vector<Place> places;
  for (std::size_t i = 0; i < loci.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (const Vector2& centre : intersections(loci[i], loci[j])) {
        Packing trial = packing;
        const DiskId disk = add_disk(trial, centre, radius);
        const Vector2 n = geometric_normal(trial, disk, loci[i].body);
        const Vector2 m = geometric_normal(trial, disk, loci[j].body);
        const bool straddles = n.x() * m.x() <= 1e-12 && n.y() + m.y() > 0.1;
        bool free = true;
        for (const Locus& other : loci) {
          if (other.body == loci[i].body || other.body == loci[j].body) continue;
          free = free && geometric_gap(trial, disk, other.body) > 1e-3;
        }
        if (straddles && free) places.push_back({centre, loci[i].body, loci[j].body});
      }
    }
  }
  std::sort(places.begin(), places.end(),
            [](const Place& p, const Place& q) { return p.centre.y() < q.centre.y(); });
  return places;
}

}  // namespace

Packing random_pile(std::uint64_t seed, int count, double mu) {
  Random random(seed);
  constexpr double kChoices[] = {0, 0.1, 0.3, 0.8, 1.5};
  Packing packing = empty_scene();
  const double width = random.uniform(2.2, 5);
  add_wall(packing, {0, 0}, {0, 1});
  add_wall(packing, {0, 0}, {1, 0});
  add_wall(packing, {width, 0}, {-1, 0});
  while (packing.disk_count() < count) {
    const double radius = random.uniform(0.7, 1);
    const std::vector<Place> places = resting_places(packing, radius);
    if (places.empty()) continue;
    const Place place = places[random.below(std::min<std::size_t>(3, places.size()))];
    const DiskId disk = add_disk(packing, place.centre, radius, radius * radius);
    for (const Body body : {place.first, place.second})
      touch(packing, disk, body, mu < 0 ? kChoices[random.below(std::size(kChoices))] : mu);
  }
  for (std::size_t i = packing.contacts.size(); i > 1; --i)
    std::swap(packing.contacts[i - 1], packing.contacts[random.below(i)]);
  return packing;
}

std::vector<int> random_order(int count, Random& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

Packing permuted(const Packing& packing, const std::vector<int>& disks, const std::vector<int>& contacts) {
  Packing result = packing;
  std::vector<int> number(disks.size());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    result.disks[i] = packing[DiskId(disks[i])];
    number[static_cast<std::size_t>(disks[i])] = static_cast<int>(i);
  }
  const auto renamed = [&](DiskId disk) { return DiskId(number[static_cast<std::size_t>(disk.value())]); };
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    Contact& contact = result.contacts[k];
    contact = packing[ContactId(contacts[k])];
    contact.a = renamed(contact.a);
    if (!contact.b.is_wall()) contact.b = Body::disk(renamed(contact.b.disk_id()));
  }
  return result;
}

Packing with_bodies_swapped(const Packing& packing) {
  Packing result = packing;
  for (Contact& contact : result.contacts) {
    if (contact.b.is_wall()) continue;
    std::swap(contact.lever_a, contact.lever_b);
    const DiskId a = contact.a;
    contact.a = contact.b.disk_id();
    contact.b = Body::disk(a);
    contact.normal = -contact.normal;
  }
  return result;
}

Packing mirrored(const Packing& packing) {
  const auto mirror = [](Vector2& v) { v.x() = -v.x(); };
  Packing result = packing;
  mirror(result.gravity);
  for (Disk& disk : result.disks) {
    mirror(disk.position);
    disk.load.x() = -disk.load.x();
    disk.load.z() = -disk.load.z();
  }
  for (Wall& wall : result.walls) {
    mirror(wall.point);
    mirror(wall.normal);
  }
  for (Contact& contact : result.contacts) {
    mirror(contact.normal);
    contact.T = -contact.T;
  }
  return result;
}

Packing rotated(const Packing& packing, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto turn = [&](Vector2& v) { v = Vector2(c * v.x() - s * v.y(), s * v.x() + c * v.y()); };
  Packing result = packing;
  turn(result.gravity);
  for (Disk& disk : result.disks) {
    turn(disk.position);
    Vector2 load = disk.load.head<2>();
    turn(load);
    disk.load.head<2>() = load;
  }
  for (Wall& wall : result.walls) {
    turn(wall.point);
    turn(wall.normal);
  }
  for (Contact& contact : result.contacts) turn(contact.normal);
  return result;
}

Packing rescaled(const Packing& packing, double length, double mass, double acceleration) {
  const double force = mass * acceleration;
  Packing result = packing;
  result.gravity *= acceleration;
  result.named_force_unit *= force;
  for (Disk& disk : result.disks) {
    disk.position *= length;
    disk.radius *= length;
    disk.mass *= mass;
    disk.inertia *= mass * length * length;
    disk.load.head<2>() *= force;
    disk.load.z() *= force * length;
  }
  for (Wall& wall : result.walls) wall.point *= length;
  for (Contact& contact : result.contacts) {
    contact.gap *= length;
    contact.R *= force;
    contact.T *= force;
  }
  return result;
}

}  // namespace indet::zoo
