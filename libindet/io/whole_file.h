#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace indet {

/// A file that takes its name when it is whole: it is written under a temporary name in the folder of its
/// destination, synced and renamed. What is not committed leaves nothing behind, and an old file stays as it
/// was. Devices and FIFOs are written in place.
class WholeFile {
 public:
  /// Throws InputError where the path cannot be written.
  explicit WholeFile(const std::filesystem::path& path);
  ~WholeFile();
  WholeFile(WholeFile&& other) noexcept;
  WholeFile& operator=(WholeFile&& other) = delete;

  /// Throws LibraryError if writing fails (a full disk). Once.
  void commit(std::span<const unsigned char> bytes);

 private:
  std::filesystem::path path_;       ///< As given, for messages.
  std::filesystem::path target_;     ///< With links followed.
  std::filesystem::path temporary_;  ///< Empty for a stream, and after the end.
};

/// All at once.
void write_whole_file(const std::filesystem::path& path, const std::string& bytes);

/// The name that a file is written under until it is whole: .NAME.HOST.PROCESS.COUNTER.tmp, new with every
/// call. A long NAME is cut, and a dot in HOST is written as −.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Removes from a folder the temporary files of writers that were killed: those of this host whose process is
/// no longer alive, and, since other hosts cannot be asked, all that are older than a day. The files of
/// writers at work stay, in whatever process. Precondition: hosts of one name see each other's processes.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace indet
