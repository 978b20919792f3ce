#include "libsim/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/error.h"
#include "libsim/unsupported.h"

namespace indet::sim {

void World::add(const Disk& disk) {
  id.push_back(disk.id);
  x.push_back(disk.position.x());
  y.push_back(disk.position.y());
  angle.push_back(disk.angle);
  vx.push_back(disk.fixed ? 0 : disk.velocity.x());
  vy.push_back(disk.fixed ? 0 : disk.velocity.y());
  omega.push_back(disk.fixed ? 0 : disk.angular_velocity);
  fixed.push_back(disk.fixed ? 1 : 0);
  radius.push_back(disk.radius);
  mass.push_back(disk.mass);
  inertia.push_back(disk.inertia);
  load_x.push_back(disk.load.x());
  load_y.push_back(disk.load.y());
  load_torque.push_back(disk.load.z());
}

int World::free_size() const { return static_cast<int>(std::count(fixed.begin(), fixed.end(), 0)); }

Levers World::levers_of(int a, int b) const {
  const auto found = levers.find({a, b});
  return found == levers.end() ? Levers{} : found->second;
}

Arms World::arms_of(int a, int b) const {
  const Levers found = levers_of(a, b);
  return {std::isnan(found.a) ? 1 : found.a / radius[a], std::isnan(found.b) ? 1 : found.b / radius[b]};
}

double World::largest_arm() const {
  double largest = 1;
  for (const auto& [bodies, lengths] : levers) {
    const Arms arms = arms_of(bodies.first, bodies.second);
    largest = std::max({largest, arms.a, arms.b});
  }
  return largest;
}

Units World::units() const {
  Units units;
  double total = 0;
  double largest = 0;
  for (int i = 0; i < size(); ++i) {
    largest = std::max(largest, radius[i]);
    if (fixed[i]) continue;
    total += mass[i];
  }
  if (free_size() == 0) return units;
  units.mass = total / free_size();
  units.length = largest;
  units.force = named_force_unit > 0 ? named_force_unit : gravity.norm() * units.mass;
  if (!(units.force > 0)) {
    throw InputError("the scene has no gravity, so it must name its unit of force (force_unit)");
  }
  units.time = std::sqrt(units.mass * units.length / units.force);
  return units;
}

double World::kinetic_energy() const {
  double energy = 0;
  for (int i = 0; i < size(); ++i) {
    energy += 0.5 * (mass[i] * (vx[i] * vx[i] + vy[i] * vy[i]) + inertia[i] * omega[i] * omega[i]);
  }
  return energy;
}

double World::fastest_speed() const {
  double fastest = 0;
  for (int i = 0; i < size(); ++i) {
    fastest = std::max({fastest, std::sqrt(vx[i] * vx[i] + vy[i] * vy[i]), radius[i] * std::abs(omega[i])});
  }
  return fastest;
}

void World::bring_to_rest() {
  std::fill(vx.begin(), vx.end(), 0.0);
  std::fill(vy.begin(), vy.end(), 0.0);
  std::fill(omega.begin(), omega.end(), 0.0);
}

World world_of(const Packing& packing, const Friction& friction) {
  refuse_unsupported(packing, "a simulation");
  World world;
  for (const Disk& disk : packing.disks) world.add(disk);
  for (const Contact& contact : packing.contacts) {
    int a = contact.a.value();
    int b = contact.b.code();
    Levers levers{contact.lever_a, contact.lever_b};
    if (std::isnan(levers.a) && std::isnan(levers.b)) continue;
    if (b >= 0 && b < a) {
      std::swap(a, b);
      std::swap(levers.a, levers.b);
    }
    world.levers[{a, b}] = levers;
  }
  world.walls = packing.walls;
  world.gravity = packing.gravity;
  world.friction = friction;
  world.named_force_unit = packing.named_force_unit;
  return world;
}

Friction friction_of(const Packing& packing, const FrictionChoice& choice) {
  std::optional<double> disk;
  std::optional<double> wall;
  for (const Contact& contact : packing.contacts) {
    const bool at_wall = contact.b.is_wall();
    if (at_wall ? choice.wall.has_value() : choice.disk.has_value()) continue;
    std::optional<double>& seen = at_wall ? wall : disk;
    if (seen && *seen != contact.mu) {
      throw InputError(fmt::format("contacts {} have different friction coefficients ({} and {}); give {}",
                                   at_wall ? "with walls" : "of two disks", *seen, contact.mu,
                                   at_wall ? "--wall-mu" : "--mu"));
    }
    seen = contact.mu;
  }
  const Friction usual;
  return {choice.disk.value_or(disk.value_or(usual.disk)), choice.wall.value_or(wall.value_or(usual.wall))};
}

Packing packing_of(const World& world, const std::vector<ContactState>& contacts) {
  Packing packing;
  packing.walls = world.walls;
  packing.gravity = world.gravity;
  packing.named_force_unit = world.named_force_unit;
  for (int i = 0; i < world.size(); ++i) {
    packing.disks.push_back(Disk{.id = world.id[i],
                                 .position = {world.x[i], world.y[i]},
                                 .radius = world.radius[i],
                                 .mass = world.mass[i],
                                 .inertia = world.inertia[i],
                                 .angle = world.angle[i],
                                 .velocity = {world.vx[i], world.vy[i]},
                                 .angular_velocity = world.omega[i],
                                 .load = {world.load_x[i], world.load_y[i], world.load_torque[i]},
                                 .fixed = world.fixed[i] != 0});
  }
  for (const ContactState& state : contacts) {
    Contact contact;
    contact.a = DiskId(state.a);
    contact.b = Body::from_code(state.b);
    contact.normal = geometric_normal(packing, contact.a, contact.b);
    contact.gap = geometric_gap(packing, contact.a, contact.b);
    contact.mu = state.mu;
    contact.R = state.R;
    contact.T = state.T;
    const Levers levers = world.levers_of(state.a, state.b);
    contact.lever_a = levers.a;
    contact.lever_b = levers.b;
    packing.contacts.push_back(contact);
  }
  return packing;
}

Imbalance imbalance_of(const World& world, const std::vector<ContactState>& contacts) {
  const int n = world.size();
  std::vector<double> fx(n), fy(n), torque(n);
  for (int i = 0; i < n; ++i) {
    if (world.fixed[i]) continue;
    fx[i] = world.mass[i] * world.gravity.x() + world.load_x[i];
    fy[i] = world.mass[i] * world.gravity.y() + world.load_y[i];
    torque[i] = world.load_torque[i] / world.radius[i];
  }
  for (const ContactState& c : contacts) {
    const double x = c.R * c.nx + c.T * c.ny;
    const double y = c.R * c.ny - c.T * c.nx;
    const Arms arms = world.levers.empty() ? Arms{} : world.arms_of(c.a, c.b);
    const auto add = [&](int disk, double side, double arm) {
      if (world.fixed[disk]) return;
      fx[disk] += side * x;
      fy[disk] += side * y;
      torque[disk] += arm * c.T;
    };
    add(c.a, 1, arms.a);
    if (c.b >= 0) add(c.b, -1, arms.b);
  }
  const double unit = world.units().force;
  Imbalance result;
  for (int i = 0; i < n; ++i) {
    const double force = std::max(std::abs(fx[i]), std::abs(fy[i])) / unit;
    const double turn = std::abs(torque[i]) / unit;
    if (std::max(force, turn) > result.worst() || result.disk < 0) result.disk = i;
    result.force = std::max(result.force, force);
    result.torque = std::max(result.torque, turn);
  }
  return result;
}

}  // namespace indet::sim
