#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace indet::app {

/// Reads HDF5 files in a process of its own, as the caller is going to. HDF5 1.10 may end the process, or
/// never return, where headers are forged. Throws InputError that names the first file where that happened;
/// exceptions of `read` are left to the caller's own reading. Passes over what is not a file. Precondition:
/// no other thread uses HDF5.
void try_reading(const std::vector<std::filesystem::path>& paths,
                 const std::function<void(const std::filesystem::path&)>& read);

/// The same for one file with the readers of all of its parts.
void try_reading(const std::string& path);

}  // namespace indet::app
