#pragma once

#include <cstdint>

#include "libindet/packing/packing.h"

namespace indet::zoo {

// A packing with bodies and levers of another kind, by chance.

/// Levers between 0.7 and 1.2 radii at most of the contacts.
Packing with_levers(Packing packing, std::uint64_t seed);

/// About a third of the disks fixed, but not all, without the contacts that have no equations then.
Packing with_fixed_disks(Packing packing, std::uint64_t seed);

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
