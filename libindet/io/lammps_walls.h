#pragma once

#include <string>
#include <vector>

#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_dump.h"
#include "libindet/io/packing_builder.h"

namespace indet {

/// Adds walls and their contacts from the columns of `fix wall/gran … contacts` to `builder`, a fix at a
/// time. The contact points of a fix must lie on planes that stand still: one plane of any direction, two
/// opposite ones (`xplane 0 12`), the sides of a block along the axes, or several planes each of which two
/// disks touch (the sides of a prism). `rows`: of the disks, in the order of the packing. Throws InputError
/// for a curved or moving wall.
void read_lammps_walls(const DumpFrame& frame, const LammpsColumns& names, const Plane& plane,
                       const std::vector<int>& rows, PackingBuilder& builder);

}  // namespace indet
