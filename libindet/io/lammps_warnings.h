#pragma once

#include "libindet/io/imported_packing.h"
#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_dump.h"

namespace indet {

/// Warns where numbers were printed with few digits, and sets `imported.rounding`; warns where normal forces
/// have tangential parts or tangential ones normal parts, of which `odd_parts` is the largest.
void warn_of_rounding(ImportedPacking& imported, const DumpPair& dumps, const LammpsColumns& names,
                      double odd_parts);

/// Warns of atoms outside the box or behind a wall.
void warn_of_atoms_outside(ImportedPacking& imported, const DumpFrame& atoms, const Plane& plane);

}  // namespace indet
