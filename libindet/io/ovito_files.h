#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// A packing for OVITO, as two text files: particles as extended XYZ, bonds as LAMMPS writes them with `dump
/// local`. Both have one frame.
///
/// Particles are the disks (species X) and, after them, the feet of contacts with walls (species W) and the
/// images that contacts across a periodic boundary are with (species I), as in io/vtk_grid.h; columns
/// species, pos (x, y, 0), id, radius, mass. The ids of disks are their own where these fit (io/file_ids.h),
/// those of feet and images the next ones. These have mass 0 and the radius kFootRadius r_max: OVITO takes a
/// radius of 0 for an unknown one. A cell is the Lattice, with pbc; where one of its vectors is missing, a
/// perpendicular one as long as the packing stands in its place, and pbc is F there.
///
/// Bonds are the contacts, in their order; columns index (from 1), ParticleIdentifiers.A and .B (names that
/// OVITO knows), mu, gap, R_mg, T_mg, and with `ranges` (else null) the columns of the table of contacts
/// (io/contact_columns.h); an outcome is a number, 0 … 4 for optimal … not_requested. `forces` (2M) and
/// `ranges` are given in the scene's unit of force. Unknown values are nan, unbounded ones inf.
void write_ovito_files(const std::filesystem::path& particles, const Packing& packing,
                       const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges);
inline constexpr double kFootRadius = 0.02;

/// Where the bonds of the particles in `particles` are written: NAME.extxyz and NAME.bonds.dump.
std::filesystem::path bonds_path_of(const std::filesystem::path& particles);

/// True if a text begins as one of these files.
bool is_particle_file(std::string_view text);
bool is_bond_file(std::string_view text);

}  // namespace indet
