#pragma once

#include <string>

namespace indet::app {

/// For subcommands that read a packing. Reads the file on trial (try_reading); throws InputError that says
/// what to do instead if it is the file or folder of an ensemble, a CSV scene or a LAMMPS dump.
void require_packing(const std::string& path);

/// The same for what can also be the file of an ensemble.
void require_packing_or_ensemble(const std::string& path);

}  // namespace indet::app
