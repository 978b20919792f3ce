#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "libindet/io/hdf5_file.h"

namespace indet::app {

/// Reads HDF5 files in a process of its own, as the caller is going to. HDF5 1.10 may end the process, or
/// never return, where headers are forged. Throws InputError that names the first file where that happened;
/// exceptions of `read` are left to the caller's own reading. Passes over what is not a file. Precondition:
/// no other thread uses HDF5.
void try_reading(const std::vector<std::filesystem::path>& paths,
                 const std::function<void(const std::filesystem::path&)>& read);

/// Opens a file of indet once its parts were read on trial. The handle is passed on to all readers, so that
/// they read the same file. Throws InputError.
Hdf5File open_on_trial(const std::filesystem::path& path);

}  // namespace indet::app
