#pragma once

#include <vector>

#include "libindet/exact/body_motion.h"
#include "libindet/packing/loads.h"
#include "libindet/packing/packing.h"

namespace indet {

/// What a motion of the bodies does at a contact.
enum class ContactMotion : std::uint8_t {
  kRests,   ///< neither (the bodies may roll on each other)
  kSlides,  ///< it slides, and opens by μ times as much: associated sliding
  kOpens
};

/// How fast the surfaces of a contact move apart, and past each other (a against b along t̂), in units of the
/// motion:
///
///   opening = n̂·u,  sliding = t̂·u + l_a ω_a + l_b ω_b,  u = v_a − v_b − e·l
///
/// with e the rate of compression of the cell and l the branch vector.
struct ContactRates {
  double opening = 0, sliding = 0;
};
std::vector<ContactRates> contact_rates(const Packing& packing, const exact::BodyMotion& motion);

/// What each contact does. Precondition: the largest entry of the motion is 1.
std::vector<ContactMotion> contact_motions(const Packing& packing, const exact::BodyMotion& motion);

/// What loads do along a motion, per unit of it, in the scene's units.
double load_power(const Packing& packing, const Loads& loads, const exact::BodyMotion& motion);

/// Those that have a velocity, ascending.
std::vector<DiskId> moving_disks(const exact::BodyMotion& motion);

}  // namespace indet
