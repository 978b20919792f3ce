#pragma once

#include "libindet/io/imported_packing.h"
#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_dump.h"
#include "libindet/io/lammps_reader.h"

namespace indet {

/// What two dumps hold and a packing does not.
struct LammpsRemainder {
  double discarded = 0;  ///< Largest part of a force that the projections on normal and tangent drop.
  int apart = 0;         ///< Pairs that neither touch nor push each other.
};

/// Appends what the user should know about the dumps to `imported.warnings`, and sets `imported.rounding`.
void warn_of_oddities(ImportedPacking& imported, const LammpsOptions& options, const LammpsColumns& columns,
                      const DumpFrame& atoms, const LammpsRemainder& remainder);

}  // namespace indet
