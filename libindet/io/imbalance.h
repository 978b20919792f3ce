#pragma once

#include <string>
#include <vector>

#include "libindet/io/imported_packing.h"

namespace indet {

/// A cause that forces which do not balance may have, and what would be left without it.
struct ImbalanceCause {
  std::string text;       ///< "lever arms pair=mid-overlap,wall=radius leave torques up to 1.4e-14 mg r"
  bool explains = false;  ///< Without it, all that can be checked would balance.
};

/// The causes that an importer's user can remedy, with what each would leave. Residuals are those of the
/// known forces, with the levers of the packing, in mg.
///
/// - levers: the smallest torque of all choices that were tried;
/// - gravity: the net forces with g = median of −ΣF/m, which few odd disks do not disturb;
/// - missing walls: the net forces on the disks that reach to no side of the smallest box around the packing;
/// - fixed disks: the net forces on the disks that are not of one type; without types, on those that balance;
/// - friction: contacts beyond the Coulomb limit (friction does not enter the balance);
/// - motion: a disk whose kinetic energy is above tolerance::kMoving.
///
/// Precondition: all forces are known.
std::vector<ImbalanceCause> find_causes(const ImportedPacking& imported, double tolerance);

}  // namespace indet
