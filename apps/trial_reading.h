#pragma once

#include <string>

namespace indet::app {

/// Reads an HDF5 file in a process of its own, with all readers. HDF5 1.10 may end the process, or never
/// return, where headers are forged. Throws InputError where that happened; errors that the readers report
/// are left to the caller. Does nothing with what is not a file. Precondition: no other thread uses HDF5.
void try_reading(const std::string& path);

}  // namespace indet::app
