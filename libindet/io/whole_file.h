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

/// The name that a file is written under until it is whole: .NAME.PID.COUNTER.tmp, new with every call.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Removes what writers of this file left behind when they were killed. Not while somebody else writes it.
void remove_leftovers(const std::filesystem::path& path);

}  // namespace indet
