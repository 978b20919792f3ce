#include "libindet/io/destination.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "libindet/base/error.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", path.string(), reason));
}

/// Follows a link that leads to nothing yet. (std::filesystem::canonical wants the end to exist.)
fs::path end_of_links(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as in Linux
  fs::path end = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks; ++i) {
    if (!fs::is_symlink(end, error)) return end;
    end = end.parent_path() / fs::read_symlink(end);
  }
  refuse_to_write(path, ELOOP);
}

/// A file appears under another name first, so its folder must take new names.
void check_folder(const fs::path& path, const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw UnwritablePath(fmt::format("{}: the folder {} does not exist", path.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse_to_write(path, errno);
}

}  // namespace

void refuse_to_write(const fs::path& path, int error) {
  const std::string reason = std::generic_category().message(error);
  if (error == ENOSPC || error == EDQUOT)
    throw WritingFailed(fmt::format("{}: writing failed ({})", path.string(), reason));
  throw UnwritablePath(fmt::format("{}: cannot be written ({})", path.string(), reason));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) refuse_to_write(folder, error.value());
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse_to_write(folder, errno);
}

Destination destination_of(const fs::path& path) {
  if (!path.has_filename()) refuse(path, "is a folder; a file can only be written beside it");
  struct stat found {};
  Destination destination{.path = path};
  if (stat(path.c_str(), &found) != 0) {
    if (errno != ENOENT && errno != ENOTDIR) refuse_to_write(path, errno);
    destination.path = end_of_links(path);
    check_folder(path, destination.path);
    return destination;
  }
  if (S_ISDIR(found.st_mode)) refuse(path, "is a folder; a file can only be written beside it");
  if (S_ISBLK(found.st_mode)) refuse(path, "is a block device");
  if (S_ISREG(found.st_mode)) {
    std::error_code error;
    if (fs::is_symlink(path, error)) destination.path = fs::canonical(path, error);
    if (error) refuse_to_write(path, error.value());
    check_folder(path, destination.path);
    return destination;
  }
  destination.is_stream = true;
  if (access(path.c_str(), W_OK) != 0) refuse_to_write(path, errno);
  return destination;
}

}  // namespace indet
