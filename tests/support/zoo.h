#pragma once

#include <cstdint>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/packing/packing.h"

namespace indet::zoo {

/// Packings with known answers, shared by tests, benchmarks and tutorials. Unless a comment says otherwise
/// all disks have radius 1 and mass 1, gravity is (0, −1), so that mg = 1, and forces below are in mg.
/// n̂ points from b to a, t̂ = (n_y, −n_x): on a floor t̂ = (1, 0), on a wall at the left t̂ = (0, −1).

/// The paper's two contacts (Sec. II H): one disk in a groove whose contacts are ±φ from the vertical.
///
///      \  ( )  /      contact 0: n̂ = (sin φ, cos φ), contact 1: n̂ = (−sin φ, cos φ)
///       \_____/
///
/// c₁₁ forms: nullity 1, R_0 = R_1 = R, T_0 = −T_1 = T, 2R cos φ − 2T sin φ = mg. With T = ±μR, tan φ < 1/μ:
///   R ∈ [1/2 / (cos φ + μ sin φ), 1/2 / (cos φ − μ sin φ)],  T ∈ [−μ R_min, μ R_max]   (cf. [32]–[34], [36])
///   δR = μ sin φ / (cos²φ − μ² sin²φ) [35],  δT = μ cos φ / (cos²φ − μ² sin²φ) [37]
/// tan φ ≥ 1/μ: the disk can be jammed: R_max = T_max = +inf. At φ = 0 the contacts coincide: nullity 2.
/// With μ = 0: a point, R = 1/2 / cos φ.
Packing wedge(double phi, double mu);

/// The closed forms of wedge(φ, μ), tan φ < 1/μ.
struct WedgeRanges {
  double R_min, R_max, T_min, T_max;  ///< T of contact 0
  double delta_R, delta_T;
};
WedgeRanges wedge_ranges(double phi, double mu);

/// One disk on a floor: a point, R = 1, T = 0. (nullity 0)
Packing disk_on_floor(double mu);

/// One disk on a plane inclined by `angle` > 0: empty at any friction; it rolls.
Packing disk_on_incline(double angle, double mu);

/// Two disks on a floor carry a third; the two do not touch. θ is the angle of the upper contacts from the
/// vertical, sin θ > 1/2 (so that there is a gap below).
///
///        (2)          contacts 0, 1: disk 2 on disks 0, 1;  2, 3: disks 0, 1 on the floor
///      (0) (1)        torque on the base: |T_floor| = |T_upper|; base x: R sin θ = T (1 + cos θ)
///     _________       ⇒ R = 1/2, T = tan(θ/2)/2, R_floor = 3/2, |T_floor| = tan(θ/2)/2
///
/// Stands (a point) if mu_upper ≥ tan(θ/2) and mu_floor ≥ tan(θ/2)/3; else empty: all three disks move.
Packing pyramid(double theta, double mu_upper, double mu_floor);

/// `count` disks stacked in zigzag between two vertical walls on a frictionless floor, without friction. θ:
/// angle of the contacts between disks from the vertical, 0 < θ ≤ 60°.
///
///   | (2) |   contacts: 0 floor; 1 … count − 1: disk k on disk k − 1; then the wall of each disk
///   |  (1)|   A point. With a_k = count − k disks from number k up: R_floor = count, R_{k on k−1} = a_k /
///   cos θ,
///   |(0)  |   wall of disk k: (a_k + a_{k+1}) tan θ, and a_1 tan θ for disk 0 (a_count = 0).
Packing frictionless_column(int count, double theta);

/// The same column with friction at every contact: 2M − 3N = count; bounded for small θ.
Packing column(int count, double theta, double mu);

/// `count` disks, each right on top of the one below, and each touching a wall on either side: unbounded.
Packing column_between_walls(int count, double mu);

/// `count` disks side by side on a floor, the outer ones touching a wall each: unbounded.
///
///   contacts: 0 … count − 1: disk k on the floor; then disk k on disk k − 1; then the left and the right
///   wall The tangential force of a wall is 1/2 at most upwards (the disk lifts off the floor and hangs on
///   its neighbour, too) and, for count ≥ 6, (1 + 3μ)/(2 − 2μ) downwards (of its neighbour that one lifts
///   off).
Packing row_between_walls(int count, double mu);

/// One disk between two vertical walls, no floor: T = ∓1/2 is determined, R ∈ [1/(2μ), ∞). (nullity 1)
Packing pinched_disk(double mu);

/// Two grooves side by side: two independent blocks, nullity 2.
Packing two_wedges(double phi_left, double mu_left, double phi_right, double mu_right);

/// A disk on a floor that touches a vertical wall at its left.
///
///   |( )      contact 0: floor, 1: wall.  T_floor = −R_wall, T_wall = R_wall, R_floor = 1 + R_wall:
///   nullity 1.
///   |___      mu_wall < 1: R_wall = 0, a point though the nullity is 1: the wall transmits nothing.
///             mu_wall ≥ 1, mu_floor < 1: R_wall ∈ [0, mu_floor / (1 − mu_floor)], dim F = 1;
///             mu_wall = 1: the wall's contact slides in every state. mu_floor ≥ 1: R_wall unbounded.
Packing corner(double mu_floor, double mu_wall);

/// The groove with a torque on its disk, in units of r mg; tan φ > μ. At the critical torque
/// μ / (cos φ (1 + μ²)) both contacts must slide: F is a point, of nullity 1. Above it F is empty, below it
/// dim F = 1.
Packing spun_wedge(double phi, double mu, double torque);
double spun_wedge_critical_torque(double phi, double mu);

/// A corner with mu_wall < 1 beside a groove: nullity 2, dim F 1.
Packing wedge_and_corner(double phi, double mu);

/// A groove without gravity, the disk pressed into it by a load of 1 (force unit 1), and a disk that touches
/// nothing. loose_load = 0: the loose disk (number 1) drops out; else F is empty, and disk 1 alone moves.
Packing wedge_and_loose_disk(double phi, double mu, double loose_load);

/// A triangular pile of a perfect lattice: `base` disks on a floor, base − 1 above them, …, 1. All disks
/// touch their neighbours: many degenerate vertices. Stands for mu ≥ tan 15°.
Packing lattice_pile(int base, double mu);
/// The same with its lowest row between two walls: it can be pressed as one likes, and can still move across.
Packing lattice_between_walls(int base, double mu);

/// A pile in a box (floor and two walls), disk by disk: each rests on two bodies, one on either side of its
/// centre, in one of the lowest places found. Radii in [0.7, 1], masses ∝ r². Friction of each contact: mu,
/// or with mu < 0 one of 0, 0.1, 0.3, 0.8, 1.5 by chance. Contacts in an order by chance. 2 contacts a disk,
/// so 2M − 3N = N. May or may not stand.
Packing random_pile(std::uint64_t seed, int count, double mu);

// The same packing seen otherwise.

/// The numbers 0 … count − 1 in an order by chance.
std::vector<int> random_order(int count, Random& random);
/// Disk i of the result is disk disks[i] of the packing, contact k is contact contacts[k].
Packing permuted(const Packing& packing, const std::vector<int>& disks, const std::vector<int>& contacts);
/// Bodies a and b of every contact between two disks change places: R and T stay.
Packing with_bodies_swapped(const Packing& packing);
/// x → −x: R stays, T changes sign.
Packing mirrored(const Packing& packing);
/// Everything, gravity too, turned about the origin: R and T stay.
Packing rotated(const Packing& packing, double angle);
/// Other units: lengths, masses and accelerations multiplied. Forces are multiplied by mass · acceleration.
Packing rescaled(const Packing& packing, double length, double mass, double acceleration);

}  // namespace indet::zoo
