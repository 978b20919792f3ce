#pragma once

#include <filesystem>
#include <string>

namespace indet {

/// Writes a file under a temporary name in the same folder, syncs it and renames it: a file that exists is
/// whole. Throws InputError where the path cannot be written, LibraryError if writing fails (a full disk).
void write_whole_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace indet
