#pragma once

#include <vector>

#include "libindet/limit/limit.h"

namespace indet {

/// The limits of the packings of an ensemble, by the names that their files have:
///
///   tilt                    at which some disk moves, both ways
///   tilt of several disks   the same once disks that move alone are taken out (find_tilt)
///   mg on the highest disk  multiples of mg along gravity, beside what acts already
///   friction                the least factor of all coefficients of friction
namespace limit_name {
inline constexpr const char* kTilt = "tilt";
inline constexpr const char* kTiltOfSeveral = "tilt of several disks";
inline constexpr const char* kLoadOnTop = "mg on the highest disk";
inline constexpr const char* kFriction = "friction";
}  // namespace limit_name

/// Those that a packing has: without gravity it has no tilt and no highest disk, without friction no least
/// factor.
std::vector<Limit> find_member_limits(const Packing& packing);

}  // namespace indet
