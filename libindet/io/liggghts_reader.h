#pragma once

#include "libindet/io/given_walls.h"
#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"
#include "libindet/io/lammps_dump.h"

namespace indet {

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
ImportedPacking read_liggghts(const DumpFiles& files, const GivenWalls& walls,
                              const ImportSettings& settings);

}  // namespace indet
