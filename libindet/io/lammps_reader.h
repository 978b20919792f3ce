#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "libindet/io/imported_packing.h"

namespace indet {

/// What a LAMMPS dump does not say, and where to find what it says.
struct LammpsOptions {
  std::filesystem::path atoms;           ///< `dump custom`
  std::filesystem::path contacts;        ///< `dump local`
  std::optional<std::int64_t> timestep;  ///< None: the last frame of each.
  double friction = -1;                  ///< Of every contact; ≥ 0.
  Vector2 gravity{0, -1};
  /// Names of columns that differ from the defaults, e.g. {"radius", "c_r"}. Keys: id, x, y, radius, mass,
  /// vx, vy, omegaz of atoms; atom1, atom2, fx, fy, p1, p2 of contacts; "wall:NAME" with the id of a wall fix
  /// (the prefix of its columns). Where a wall is named, only named ones are read.
  std::map<std::string, std::string> columns;
};

/// Reads a packing from two LAMMPS text dumps (docs/importing.md). Columns are found by name.
///
///   atoms     id x y radius mass [vx vy omegaz], and for each wall fix f_NAME[1…8]: flag, force of the wall
///             on the atom x y z, contact point x y z, radius
///   contacts  c_pp[1] c_pp[2] (two atoms), c_pl[3] c_pl[4] (normal force x y on the first),
///             c_pl[5] c_pl[6] (tangential force x y on the first)
///
/// n̂ is computed from the positions of two disks, and from contact point to centre at a wall; R and T are the
/// projections of the forces. Walls are planes through the contact points; a wall that nothing touches is
/// not in a dump. Disks are sorted by id, contacts by their disks and walls, so the order of rows does not
/// matter. Throws InputError that names file, line and reason.
ImportedPacking read_lammps(const LammpsOptions& options);

}  // namespace indet
