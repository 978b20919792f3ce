#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "libindet/packing/packing.h"

namespace indet {

/// The part of a packing that a defect is in; importers turn it into a file and a line.
enum class PackingPart { kScene, kCell, kStress, kDisk, kWall, kContact };

/// The first thing that is wrong with a packing.
struct Defect {
  PackingPart part = PackingPart::kScene;
  int index = -1;      ///< Row of the part, from 0; −1 for scene, cell, stress.
  std::string reason;  ///< "mass must be positive, but is -1".
};

/// Two bodies and an image as one key, the same for (a, b, image) and (b, a, −image).
using ContactKey = std::array<std::int32_t, 4>;
ContactKey contact_key(const Contact& contact);

/// Looks for: NaN or inf (a load of a wall may be NaN: it is not free then); radius, mass or inertia ≤ 0 (of
/// a fixed disk, mass or inertia < 0); negative μ; an index out of range; a contact of a disk with itself
/// (not with an image of itself) or given twice, or between two bodies without equations (readers leave these
/// out); an image of a wall, or in a direction that is not periodic; a lever that is not in (0, 2r], or of a
/// wall; bounds of a force that leave none; a normal that is not of unit length or disagrees with the
/// positions; bodies of a contact that cannot touch; a cell that is no parallelogram, with a wall across it
/// or gravity that nothing takes; a stress on what is no full cell or has fixed bodies; neither gravity nor a
/// unit of force. (A contact of a wall with a wall cannot be expressed in a Packing; importers report it.)
/// Returns nothing if the packing can be used.
std::optional<Defect> find_defect(const Packing& packing);

/// Throws InputError with the defect, prefixed by `source` (a file name), if there is one.
void validate(const Packing& packing, const std::string& source);

}  // namespace indet
