#pragma once

#include <filesystem>

#include "libindet/io/hdf5_file.h"

namespace indet::app {

/// Opens the file of a packing for a subcommand that reads one, with all that it may hold beside the packing
/// (open_on_trial). Throws InputError, which says what to do instead if the path is the file or folder of an
/// ensemble, a CSV scene or a LAMMPS dump.
Hdf5File open_packing(const std::filesystem::path& path);

/// The same for what can also be the file of an ensemble.
Hdf5File open_packing_or_ensemble(const std::filesystem::path& path);

}  // namespace indet::app
