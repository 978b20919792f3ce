#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace indet {

/// The bytes of a file.
struct FileText {
  std::filesystem::path path;
  std::string bytes;
};

/// A file that takes its name when it is whole: it is written under a temporary name in the folder of its
/// destination, synced and renamed. What is not committed leaves nothing behind, and an old file stays as it
/// was. Devices and FIFOs are written in place.
class WholeFile {
 public:
  /// Throws as destination_of, or WritingFailed on a full disk.
  explicit WholeFile(const std::filesystem::path& path);
  ~WholeFile();
  WholeFile(WholeFile&& other) noexcept;
  WholeFile& operator=(WholeFile&& other) = delete;

  /// Throws WritingFailed, Interrupted without permission. Once.
  void commit(std::span<const unsigned char> bytes);

 private:
  friend void write_whole_files(const std::vector<FileText>& texts);
  friend void write_note(const std::filesystem::path& path, const std::string& bytes);
  void write(std::span<const unsigned char> bytes);
  void check(int error) const;
  static void take_names(std::span<WholeFile> files, bool asks = true);

  std::filesystem::path path_;       ///< As given, for messages.
  std::filesystem::path target_;     ///< With links followed.
  std::filesystem::path temporary_;  ///< Empty for a stream, and after the end.
};

/// All at once.
void write_whole_file(const std::filesystem::path& path, const std::string& bytes);

/// The same, but for a file that has these bytes already, which is left alone.
void keep_whole_file(const std::filesystem::path& path, const std::string& bytes);

/// What a program notes about its own run, and needs no permission for (ask_before_writing).
void write_note(const std::filesystem::path& path, const std::string& bytes);

/// Files that belong together: none takes its name before all are written.
void write_whole_files(const std::vector<FileText>& texts);

/// A second name for the same bytes where the file system can, else a copy, which takes the place of a file
/// that is there. Throws UnwritablePath or WritingFailed, Interrupted without permission.
void link_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// For a program that writes nothing more once it is told to stop: `permission` is asked, on the thread that
/// writes, before files take their names. Without it, they do not. By default none is needed.
void ask_before_writing(std::function<bool()> permission);

/// For a program that is about to end at once, from any thread: removes what this process is writing under
/// temporary names. From now on, who begins a file or is to name one waits for ever.
void abandon_files();

/// The name that a file is written under until it is whole: .NAME.HOST.PROCESS.COUNTER.tmp, new with every
/// call. A long NAME is cut, and a dot in HOST is written as −.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// The name of this machine as it stands in names of files: with − for a dot.
std::string host_in_names();
/// Whether there is such a process on this host.
bool is_alive(std::int64_t process);

/// Removes from a folder the temporary files of writers that were killed: those of this host whose process is
/// no longer alive, and, since other hosts cannot be asked, all that are older than a day. The files of
/// writers at work stay, in whatever process. Precondition: hosts of one name see each other's processes.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace indet
