#pragma once

#include <filesystem>

#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"

namespace indet {

/// Reads a packing of YADE: a folder that apps/exporters/yade_export.py wrote, or a file of O.save
/// (docs/importing.md). Spheres are disks with their masses and moments of inertia; one all of whose motions
/// in the plane are blocked is fixed. Walls, and boxes along the axes, are walls. Normals, forces and (from a
/// folder) overlaps are those of the file. Friction and gravity are those of the file unless the settings
/// name others. Throws InputError that names file, line and reason.
ImportedPacking read_yade(const std::filesystem::path& input, const ImportSettings& settings);

}  // namespace indet
