#pragma once

#include <filesystem>

namespace indet {

/// Where a file that is written to a path ends up.
struct Destination {
  std::filesystem::path path;  ///< With symbolic links followed: a link stays, what it leads to is replaced.
  /// A character device or a FIFO: written in place, and neither replaced nor removed.
  bool is_stream = false;
};

/// Throws InputError where the path is a folder or a block device; UnwritablePath where its folder does not
/// exist or takes no new files.
Destination destination_of(const std::filesystem::path& path);

/// Makes a folder, and those that it lies in, unless they are there. Throws UnwritablePath, too where it is
/// there and takes no new files; WritingFailed on a full disk.
void make_folder(const std::filesystem::path& folder);

/// Throws for a path that could not be made, by the error number: WritingFailed on a full disk, else
/// UnwritablePath.
[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error);

}  // namespace indet
