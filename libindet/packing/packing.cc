#include "libindet/packing/packing.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "libindet/base/doubled_sum.h"
#include "libindet/base/error.h"

namespace indet {

int Packing::free_disk_count() const {
  return static_cast<int>(std::count_if(disks.begin(), disks.end(), [](const Disk& d) { return !d.fixed; }));
}

bool Packing::has_loaded_walls() const {
  return std::any_of(walls.begin(), walls.end(), [](const Wall& w) { return w.is_loaded(); });
}

bool Packing::floats() const { return cell.is_full() && fixed_disk_count() == 0 && disk_count() > 0; }

int Packing::expected_dimension() const {
  int directions = 0;
  for (const Wall& wall : walls)
    directions += (wall.is_free_along_normal() ? 1 : 0) + (wall.is_free_along_tangent() ? 1 : 0);
  directions += stress.imposed_count();
  return 2 * contact_count() - 3 * free_disk_count() - directions + (floats() ? 2 : 0);
}

double Packing::force_unit() const {
  if (named_force_unit > 0) return named_force_unit;
  const int count = free_disk_count();
  if (count == 0) return 1;
  double mass = 0;
  for (const Disk& disk : disks) mass += disk.fixed ? 0 : disk.mass / count;
  const double weight = gravity.stableNorm() * mass;
  if (weight > 0) return weight;
  if (const double load = largest_load(); load > 0) return load;
  double known = 0;
  for (const Contact& contact : contacts)
    known = std::fmax(known, std::fmax(std::abs(contact.R), std::abs(contact.T)));
  return known > 0 ? known : 1;
}

bool Packing::has_weight() const {
  return !gravity.isZero(0) && std::any_of(disks.begin(), disks.end(),
                                           [](const Disk& disk) { return !disk.fixed && disk.mass > 0; });
}

double Packing::largest_load() const {
  double largest = 0;
  for (int i = 0; i < disk_count(); ++i) {
    Vector3 load = wrench(DiskId(i));
    load.z() /= (*this)[DiskId(i)].radius;
    largest = std::max(largest, load.lpNorm<Eigen::Infinity>());
  }
  for (const Wall& wall : walls) {
    if (wall.is_free_along_normal()) largest = std::max(largest, std::abs(wall.load_n));
    if (wall.is_free_along_tangent()) largest = std::max(largest, std::abs(wall.load_t));
  }
  return std::max(largest, stress.largest() * 2 * max_radius());
}

double Packing::internal_force_unit() const {
  const double unit = force_unit();
  const double largest = largest_load();
  constexpr double kFar = 1000;
  if (largest == 0 || (largest < kFar * unit && unit < kFar * largest)) return unit;
  return std::exp2(std::round(std::log2(largest)));
}

double Packing::max_radius() const {
  double radius = 0;
  for (const Disk& disk : disks) radius = std::max(radius, disk.radius);
  return radius > 0 ? radius : 1;
}

Vector3 Packing::wrench(DiskId disk) const {
  const Disk& d = (*this)[disk];
  if (d.fixed) return Vector3::Zero();
  return {d.mass * gravity.x() + d.load.x(), d.mass * gravity.y() + d.load.y(), d.load.z()};
}

double Packing::lever_a(const Contact& c) const {
  return std::isnan(c.lever_a) ? (*this)[c.a].radius : c.lever_a;
}

double Packing::lever_b(const Contact& c) const {
  if (c.b.is_wall()) return 0;
  return std::isnan(c.lever_b) ? (*this)[c.b.disk_id()].radius : c.lever_b;
}

bool Packing::has_levers() const {
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const Contact& c) { return !std::isnan(c.lever_a) || !std::isnan(c.lever_b); });
}

bool Packing::has_bound_columns() const {
  return std::any_of(contacts.begin(), contacts.end(), [](const Contact& c) { return c.is_bounded(); });
}

Vector2 Packing::contact_point(const Contact& contact) const {
  return (*this)[contact.a].position - lever_a(contact) * contact.normal;
}

Vector2 Packing::branch(const Contact& contact) const {
  return centre_difference(*this, contact.a, contact.b.disk_id(), contact.image);
}

double Packing::cell_length() const { return std::max(std::sqrt(cell.area()), 2 * max_radius()); }

SceneForces Packing::simulated_forces() const {
  Eigen::VectorXd forces(2 * contact_count());
  for (int i = 0; i < contact_count(); ++i) {
    forces[2 * i] = (*this)[ContactId(i)].R;
    forces[2 * i + 1] = (*this)[ContactId(i)].T;
  }
  return SceneForces(std::move(forces));
}

bool Packing::has_simulated_forces() const {
  return std::all_of(contacts.begin(), contacts.end(),
                     [](const Contact& c) { return std::isfinite(c.R) && std::isfinite(c.T); });
}

std::string wall_name(const Wall& wall) { return wall.name.empty() ? std::to_string(wall.id) : wall.name; }

std::string contact_name(const Packing& packing, ContactId contact) {
  const Contact& c = packing[contact];
  const std::string first = std::to_string(packing[c.a].id);
  if (c.b.is_wall()) return first + "–wall " + wall_name(packing[c.b.wall_id()]);
  const std::string second = std::to_string(packing[c.b.disk_id()].id);
  if (!c.has_image()) return first + "–" + second;
  return fmt::format("{}–{} ({}, {})", first, second, c.image[0], c.image[1]);
}

Vector2 centre_difference(const Packing& packing, DiskId a, DiskId b, const Image& image) {
  Vector2 difference;
  for (const int k : {0, 1}) {
    DoubledSum sum;
    sum.add(packing[a].position[k]);
    sum.add(-packing[b].position[k]);
    if (packing.cell.a) sum.add_product(-double{1} * image[0], (*packing.cell.a)[k]);
    if (packing.cell.b) sum.add_product(-double{1} * image[1], (*packing.cell.b)[k]);
    difference[k] = sum.value();
  }
  return difference;
}

namespace {

/// Two vectors that span the same lattice as those of a cell, the shortest that do (Lagrange's reduction),
/// and what they are in vectors of the cell.
struct ShortVectors {
  std::array<Vector2, 2> vectors;
  std::array<std::array<double, 2>, 2> of_cell = {{{1, 0}, {0, 1}}};
};

ShortVectors shorten(const Cell& cell) {
  ShortVectors reduced{{*cell.a, *cell.b}};
  auto& [u, v] = reduced.vectors;
  auto& [of_u, of_v] = reduced.of_cell;
  constexpr int kMostSteps = 200;  // each shortens a vector, but for rounding
  for (int step = 0; step < kMostSteps; ++step) {
    if (v.squaredNorm() < u.squaredNorm()) {
      std::swap(u, v);
      std::swap(of_u, of_v);
    }
    const double times = std::round(u.dot(v) / u.squaredNorm());
    if (times == 0 || !std::isfinite(times)) break;
    v -= times * u;
    for (const std::size_t k : {0U, 1U}) of_v[k] -= times * of_u[k];
  }
  return reduced;
}

}  // namespace

Image nearest_image(const Packing& packing, DiskId a, DiskId b) {
  const auto& [first, second] = packing.cell;
  if (!packing.cell.is_periodic()) return {0, 0};
  const Vector2 difference = packing[a].position - packing[b].position;
  Vector2 place(0, 0);  // of the difference, in the vectors `of_cell`
  std::array<std::array<double, 2>, 2> of_cell = {{{1, 0}, {0, 1}}};
  if (packing.cell.is_full()) {
    const ShortVectors reduced = shorten(packing.cell);
    Eigen::Matrix2d vectors;
    vectors << reduced.vectors[0], reduced.vectors[1];
    place = vectors.inverse() * difference;
    of_cell = reduced.of_cell;
  } else {
    const Vector2& along = first ? *first : *second;
    place[first ? 0 : 1] = difference.dot(along) / along.squaredNorm();
  }
  // Of short vectors, the nearest image is the rounded one or next to it.
  const int reach_a = first ? 1 : 0;
  const int reach_b = second ? 1 : 0;
  Image nearest{0, 0};
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = -reach_a; i <= reach_a; ++i) {
    for (int j = -reach_b; j <= reach_b; ++j) {
      const double along_u = std::round(place.x()) + i;
      const double along_v = std::round(place.y()) + j;
      const Vector2 whole(along_u * of_cell[0][0] + along_v * of_cell[1][0],
                          along_u * of_cell[0][1] + along_v * of_cell[1][1]);
      if (!whole.allFinite() || whole.cwiseAbs().maxCoeff() > 1e9) continue;
      const Image image = {static_cast<std::int32_t>(whole.x()), static_cast<std::int32_t>(whole.y())};
      if (a == b && image == Image{0, 0}) continue;
      const double distance = centre_difference(packing, a, b, image).stableNorm();
      if (distance >= smallest) continue;
      smallest = distance;
      nearest = image;
    }
  }
  return nearest;
}

Vector2 geometric_normal(const Packing& packing, DiskId a, Body b, const Image& image) {
  if (b.is_wall()) return packing[b.wall_id()].normal.stableNormalized();
  const Vector2 difference = centre_difference(packing, a, b.disk_id(), image);
  const Vector2 normal = difference.stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) {
    throw InputError("the centres of the two disks coincide, so the contact has no normal");
  }
  return normal;
}

double geometric_gap(const Packing& packing, DiskId a, Body b, const Image& image) {
  const Disk& disk = packing[a];
  if (b.is_wall()) {
    const Wall& wall = packing[b.wall_id()];
    return (disk.position - wall.point).dot(wall.normal) - disk.radius;
  }
  const Disk& other = packing[b.disk_id()];
  return centre_difference(packing, a, b.disk_id(), image).stableNorm() - (disk.radius + other.radius);
}

}  // namespace indet
