#pragma once

#include <filesystem>

namespace indet {

/// Where a file that is written to a path ends up.
struct Destination {
  std::filesystem::path path;  ///< With symbolic links followed: a link stays, what it leads to is replaced.
  /// A character device or a FIFO: written in place, and neither replaced nor removed.
  bool is_stream = false;
};

/// Throws InputError where no file can be written: the path is a folder or a block device, its folder does
/// not exist, or permission is lacking.
Destination destination_of(const std::filesystem::path& path);

}  // namespace indet
