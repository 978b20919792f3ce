#pragma once

#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"
#include "libindet/io/lammps_dump.h"

namespace indet {

/// Reads a packing from two LAMMPS text dumps (docs/importing.md). Columns are found by name.
///
///   atoms     id x y radius (or diameter) mass [type vx vy omegaz], and for each wall fix f_NAME[1…8]: flag,
///             force of the wall on the atom x y z, contact point x y z, radius
///   contacts  c_pp[1] c_pp[2] (two atoms), c_pl[3] c_pl[4] (normal force x y on the first),
///             c_pl[5] c_pl[6] (tangential force x y on the first)
///
/// Keys of `settings.columns`: id, type, x, y, radius, diameter, mass, vx, vy, omegaz of atoms; atom1, atom2,
/// fx, fy, p1, p2, mu of contacts; "wall:NAME" with the id of a wall fix (the prefix of its columns). Where a
/// wall is named, only named ones are read.
///
/// n̂ is computed from the positions of two disks, and from contact point to centre at a wall; R and T are the
/// projections of the forces. Walls are planes through the contact points (several, if the region of the fix
/// has several sides); a wall that nothing touches is not in a dump. Disks are sorted by id, contacts by
/// their disks and walls, so the order of rows does not matter. Gravity is (0, −1) unless the settings name
/// another. Throws InputError that names file, line and reason.
ImportedPacking read_lammps(const DumpFiles& files, const ImportSettings& settings);

}  // namespace indet
