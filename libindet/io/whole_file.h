#pragma once

#include <filesystem>
#include <string>

namespace indet {

/// Writes a file under a temporary name in the same folder, syncs it and renames it: a file that exists is
/// whole. Throws InputError where the path cannot be written, LibraryError if writing fails (a full disk).
void write_whole_file(const std::filesystem::path& path, const std::string& bytes);

/// The name that a file is written under until it is whole: .NAME.PID.COUNTER.tmp, new with every call.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Removes what writers of this file left behind when they were killed. Not while somebody else writes it.
void remove_leftovers(const std::filesystem::path& path);

}  // namespace indet
