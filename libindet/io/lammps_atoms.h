#pragma once

#include <vector>

#include "libindet/io/import_settings.h"
#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_dump.h"
#include "libindet/io/packing_builder.h"

namespace indet {

/// Adds the disks of a `dump custom` to `builder` and closes them: id, x, y, radius (or diameter), mass,
/// [type, vx, vy, omegaz]. Positions may also be unwrapped (xu) or scaled (xs) as LAMMPS writes them; those
/// of the third axis, where they are in the dump, must all be the same. Returns the row of each disk, in the
/// order of the packing. Throws InputError with file and line.
std::vector<int> read_lammps_atoms(const DumpFrame& frame, const LammpsColumns& names, const Plane& plane,
                                   PackingBuilder& builder);

}  // namespace indet
