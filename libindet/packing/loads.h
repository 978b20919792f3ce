#pragma once

#include <array>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// What acts on a packing beside its contacts, or a change of it that is multiplied by a number λ (limit/):
/// gravity, forces and torques on disks, forces on loaded walls, the stress that is imposed on a cell. In the
/// scene's units.
struct Loads {
  Vector2 gravity{0, 0};           ///< acceleration; it acts on the mass of each free disk
  std::vector<Vector3> disks;      ///< force x, force y, torque of each disk; empty: none
  std::vector<Vector2> walls;      ///< along n̂ and t̂ of each wall; empty: none
  std::array<double, 4> stress{};  ///< components of Body::cell()

  /// m g + force, torque of a disk; 0 if it is fixed.
  Vector3 wrench(const Packing& packing, DiskId disk) const;
  /// Along n̂ (0) or t̂ (1) of a wall.
  double on_wall(WallId wall, int component) const {
    return walls.empty() ? 0 : walls[static_cast<std::size_t>(wall.value())][component];
  }
  bool is_zero() const;
};

/// Gravity turned by an angle (rad), counter-clockwise: g cos θ + g⊥ sin θ. By multiples of 90° exactly.
Vector2 turned(const Vector2& gravity, double angle);

/// Σ weight · loads, of two of one packing.
Loads combined(double weight, const Loads& loads, double other_weight, const Loads& others);

/// What acts on a packing as it is. 0 where a wall is not free, or a component of the stress not imposed.
Loads loads_of(const Packing& packing);

/// Why a change of loads cannot act on the packing: a force on something fixed, a stress that is not imposed.
/// Empty if it can. Preconditions: `disks` and `walls` are empty or have the sizes of the packing.
std::string defect_of(const Loads& change, const Packing& packing);

/// Whether they are multiples of each other, but for rounding. Precondition: of one packing.
bool are_parallel(const Loads& loads, const Loads& others);

/// The packing with these loads in place of its own; the unit of force stays. Precondition: as below.
Packing under_alone(const Loads& loads, Packing packing);

/// The packing under loads + λ change. Precondition: defect_of(change, packing) is empty.
Packing under(const Loads& change, double lambda, Packing packing);

}  // namespace indet
