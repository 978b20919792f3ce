#pragma once

#include <filesystem>
#include <string>

#include "apps/ensemble/units/unit.h"

namespace indet {

/// The file of one unit is a file of `indet analyze` with /simulation, /sampling, /uniform, /bias, and
///
///     /ensemble  @unit @hash @config; solver_d_R, solver_d_T f8[M]; extremal_R, solver_extremal_R i4[4, B]
///
/// All functions use HDF5: one thread at a time.
void write_unit(const std::filesystem::path& path, const Unit& unit, const UnitResult& result,
                const Provenance& provenance);

/// True if the file is there, opens, is complete and carries the hash of the unit.
bool unit_is_done(const std::filesystem::path& path, const Unit& unit);

}  // namespace indet
