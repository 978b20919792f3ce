#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet::sim {

/// The lever arms of the two bodies of a contact; NaN: the radius.
struct Levers {
  double a = std::numeric_limits<double>::quiet_NaN();
  double b = std::numeric_limits<double>::quiet_NaN();
};

/// Levers over the radius: what a tangential force adds to the torques, which are divided by the radius.
struct Arms {
  double a = 1, b = 1;
  bool operator==(const Arms&) const = default;
};

/// Coulomb coefficients of a scene.
struct Friction {
  double disk = 0.3;  ///< Between two disks.
  double wall = 0.3;  ///< Between a disk and a wall.
  bool any() const { return disk > 0 || wall > 0; }
};

/// Units in which options and criteria of the simulators are given: the mean mass m of a free disk, r_max,
/// and the packing's unit of force (mg), from which √(m r_max / mg) = √(r_max/g) is the unit of time.
struct Units {
  double mass = 1;
  double length = 1;
  double force = 1;
  double time = 1;
  double energy() const { return force * length; }
  double speed() const { return length / time; }
  double stiffness() const { return force / length; }
  double damping() const { return force * time / length; }
};

/// What is simulated: disks as flat arrays (the hot loops read them), walls, gravity and friction. All arrays
/// have one entry a disk. Contacts have levers of the length of the radius, but for those between bodies that
/// `levers` names: a packing whose contacts have others keeps them for as long as the same two bodies touch.
struct World {
  std::vector<std::int32_t> id;
  std::vector<double> x, y, angle;
  std::vector<double> vx, vy, omega;
  std::vector<double> radius, mass, inertia;
  std::vector<double> load_x, load_y, load_torque;  ///< External wrench beside gravity.
  std::vector<char> fixed;                          ///< 1: does not move, whatever acts on it.
  /// By the bodies of a contact, as in ContactState, a < b for two disks.
  std::map<std::pair<int, int>, Levers> levers;
  std::vector<Wall> walls;
  Vector2 gravity{0, 0};
  Friction friction;
  double named_force_unit = 0;

  int size() const { return static_cast<int>(x.size()); }
  void add(const Disk& disk);
  int free_size() const;  ///< Disks that are not fixed.

  Levers levers_of(int a, int b) const;  ///< Of a contact.
  Arms arms_of(int a, int b) const;
  double largest_arm() const;  ///< Of all contacts, at least 1.

  Units units() const;
  double kinetic_energy() const;
  double fastest_speed() const;  ///< Largest of |v| and r|ω|.
  /// Sets all velocities to 0.
  void bring_to_rest();
};

/// A contact of a simulated state. Bodies: a is a disk; b < 0 is wall −(b + 1), as in files. n̂ points from b
/// to a, t̂ = (n_y, −n_x); the force on a is R n̂ + T t̂.
struct ContactState {
  int a = 0;
  int b = 0;
  double nx = 0, ny = 0;
  double gap = 0;
  double mu = 0;
  double R = 0, T = 0;
  /// Change of R in the last step (implicit steps loosen their tolerance by it).
  double change = 0;
  /// Stretch ξ of the tangential spring (molecular dynamics); 0 in contact dynamics.
  double spring = 0;
  /// The last step held T at the Coulomb limit ±μR.
  bool sliding = false;
  bool operator==(const ContactState&) const = default;
};

/// Disks, walls, levers and gravity of a packing; friction is `friction`. Fixed disks are at rest.
World world_of(const Packing& packing, const Friction& friction);

/// Friction coefficients that somebody asks for; what is empty is left to the packing.
struct FrictionChoice {
  std::optional<double> disk, wall;
};

/// The friction that a packing's contacts have, unless `choice` names another; a coefficient that no contact
/// shows is that of `Friction`. Throws InputError if two contacts of a kind that `choice` leaves open differ:
/// the simulators know one coefficient a kind.
Friction friction_of(const Packing& packing, const FrictionChoice& choice = {});

/// Disks, walls and contacts as a packing; normals and gaps are recomputed from the positions.
Packing packing_of(const World& world, const std::vector<ContactState>& contacts);

/// Largest component of the out-of-balance force and torque/r on any disk, in units of force (mg), and where.
struct Imbalance {
  double force = 0;
  double torque = 0;
  int disk = -1;
  double worst() const { return force > torque ? force : torque; }
};
Imbalance imbalance_of(const World& world, const std::vector<ContactState>& contacts);

}  // namespace indet::sim
