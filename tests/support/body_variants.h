#pragma once

#include <cstdint>

#include "libindet/packing/packing.h"

namespace indet::zoo {

// A packing with bodies and levers of another kind, by chance.

/// Levers between 0.7 and 1.2 radii at most of the contacts.
Packing with_levers(Packing packing, std::uint64_t seed);

/// About a third of the disks fixed, but not all, without the contacts that have no equations then.
Packing with_fixed_disks(Packing packing, std::uint64_t seed);

/// Loads between 0 and 3 along the normal of most walls, and small ones along the tangent of some.
Packing with_loaded_walls(Packing packing, std::uint64_t seed);

/// `count` disks of radius 1 side by side on a fixed floor, under a plate that `load` presses down. Without
/// friction R of the plate is in [0, load] at each, and R of the floor larger by the weight of the disk; with
/// friction as well, for nothing can push sideways. count = 1: a point.
///
///      ▁▁▁▁▁▁▁▁▁▁    contacts 0 … count − 1: the floor, then the plate
///      ( ) ( ) ( )
///     ============
Packing disks_between_plates(int count, double load, double mu);

/// The biaxial box: columns × rows disks of radius 1 on a square lattice, between fixed walls at the left and
/// below and loaded ones at the right and above, without gravity; force unit 1. Without friction each row
/// carries a share of from_right: R ∈ [0, from_right] at each of its contacts, and columns likewise.
Packing biaxial_box(int columns, int rows, double from_right, double from_above, double mu);

/// Three disks of radius 1 in a triangular rack, each touching both others and two of three frictionless
/// walls at 120°, which a load presses inwards; no gravity, force unit 1. The loads cancel. By virtual work
/// of a uniform contraction, the forces between disks add up to (√3/2) load: each is in [0, (√3/2) load]. dim
/// F = 2.
Packing rack(double load);

/// A disk of radius and mass 1 on two fixed ones of the given radii, whose contacts are ±φ from the vertical:
/// to the disk it is the groove of zoo::wedge, contact by contact, whatever the fixed disks weigh.
///
///      ( 0 )
///     (1) (2)
Packing disk_on_two_fixed(double phi, double mu, double left_radius, double right_radius);

/// The groove of zoo::wedge with levers l_0, l_1 at its contacts. With λ = l_0/l_1, T_1 = −λ T_0 and
///   R_0 + R_1 = (1 + (1 + λ) T_0 sin φ) / cos φ,   R_0 − R_1 = −(1 − λ) T_0 cot φ.
Packing wedge_with_levers(double phi, double mu, double lever_0, double lever_1);

}  // namespace indet::zoo
