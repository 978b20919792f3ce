#pragma once

#include <map>
#include <string>
#include <vector>

#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"
#include "libindet/io/lammps_dump.h"

namespace indet {

/// A plane that no file has: the wall of a fix lies at `position` along axis 0 or 1 of the packing.
struct GivenWall {
  int axis = 0;
  double position = 0;
  std::string text;  ///< "wx1=x:0"
};

/// "wx1=x:0" items, by the name of the fix; the letters are those of the axes of `plane`. Throws InputError.
std::map<std::string, GivenWall> parse_walls(const std::vector<std::string>& items, const Plane& plane);

/// Reads a packing of LIGGGHTS (docs/importing.md). Atoms are those of read_lammps_atoms(), with columns
/// f_force_NAME[1…3], the force of the primitive wall of fix NAME (`store_force yes`) on the atom, for each
/// given wall. Contacts are those of `compute … pair/gran/local id force force_normal force_tangential torque
/// contactPoint delta`, whose columns stand in the order
///
///   1, 2 ids of the atoms, 3 flag of a periodic boundary, 4–6 force on the first, 7–9 its normal part,
///   10–12 its tangential part, 13–15 torque, 16 δ, 17–19 contact point
///
/// of which 1–6 are needed. R and T are projections of the force; an atom touches a wall where its force is
/// not zero. Throws InputError that names file, line and reason, also for a wall with forces whose plane is
/// not given.
ImportedPacking read_liggghts(const DumpFiles& files, const std::map<std::string, GivenWall>& walls,
                              const ImportSettings& settings);

}  // namespace indet
