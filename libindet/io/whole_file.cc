#include "libindet/io/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/io/destination.h"

namespace indet {
namespace {

/// Writes all of `bytes`; 0, or the error number.
int write_all(int descriptor, std::span<const unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Writes into what is there; 0, or the error number.
int write_into(const std::filesystem::path& path, std::span<const unsigned char> bytes, bool sync) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error = write_all(descriptor, bytes);
  if (error == 0 && sync && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

/// Makes a new name last; 0, or the error number.
int sync_folder_of(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

}  // namespace

WholeFile::WholeFile(const std::filesystem::path& path) : path_(path) {
  const Destination destination = destination_of(path);
  target_ = destination.path;
  if (destination.is_stream) return;
  const std::filesystem::path temporary = temporary_name(target_);
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw InputError(
        fmt::format("{}: cannot be written ({})", path.string(), std::generic_category().message(errno)));
  }
  ::close(descriptor);
  temporary_ = temporary;
}

WholeFile::~WholeFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})) {}

void WholeFile::commit(std::span<const unsigned char> bytes) {
  const auto check = [&](int error) {
    if (error == 0) return;
    throw LibraryError(
        fmt::format("{}: writing failed ({})", path_.string(), std::generic_category().message(error)));
  };
  if (temporary_.empty()) {
    check(write_into(target_, bytes, false));
    return;
  }
  check(write_into(temporary_, bytes, true));
  check(::rename(temporary_.c_str(), target_.c_str()) == 0 ? 0 : errno);
  temporary_.clear();
  check(sync_folder_of(target_));
}

void write_whole_file(const std::filesystem::path& path, const std::string& bytes) {
  WholeFile(path).commit({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<int> counter{0};
  return path.parent_path() / fmt::format(".{}.{}.{}.tmp", path.filename().string(), getpid(), counter++);
}

void remove_leftovers(const std::filesystem::path& path) {
  const std::string begin = "." + path.filename().string() + ".";
  std::error_code ignored;
  std::vector<std::filesystem::path> leftovers;
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(begin) && name.ends_with(".tmp")) leftovers.push_back(entry.path());
  }
  for (const std::filesystem::path& leftover : leftovers) std::filesystem::remove(leftover, ignored);
}

}  // namespace indet
