#include "libindet/io/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
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

/// What this process is writing under temporary names. It is not destroyed: threads may outlive main().
struct Unfinished {
  std::mutex mutex;  ///< held while a name appears or disappears
  std::set<std::filesystem::path> names;
  std::function<bool()> permission = [] { return true; };
};

Unfinished& unfinished() {
  static Unfinished* const only = new Unfinished;
  return *only;
}

constexpr std::size_t kLongestName = 150;  // of 255 bytes; a host has 64 at most
constexpr std::chrono::hours kOld{24};

bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
}

struct Writer {
  std::string host;
  pid_t process = 0;
};

/// Who writes under this name; empty if it is not a temporary one.
std::optional<Writer> writer_of(const std::string& name) {
  if (!name.starts_with('.')) return {};
  std::array<std::string, 4> parts;  // host, process, counter, "tmp"
  std::size_t end = name.size();
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const std::size_t dot = end == 0 ? std::string::npos : name.rfind('.', end - 1);
    if (dot == std::string::npos) return {};
    *part = name.substr(dot + 1, end - dot - 1);
    end = dot;
  }
  const auto& [host, process, counter, extension] = parts;
  if (end == 0 || extension != "tmp" || !is_number(process) || !is_number(counter)) return {};
  return Writer{host, static_cast<pid_t>(std::stol(process))};
}

bool is_old(const std::filesystem::path& path) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(path, error);
  return !error && std::filesystem::file_time_type::clock::now() - written > kOld;
}

}  // namespace

std::string host_in_names() {
  std::array<char, 65> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "localhost";
  std::string host = name.data();
  std::replace_if(
      host.begin(), host.end(), [](char c) { return c == '.' || c == '/'; }, '-');
  return host;
}

bool is_alive(std::int64_t process) { return kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM; }

WholeFile::WholeFile(const std::filesystem::path& path) : path_(path) {
  const Destination destination = destination_of(path);
  target_ = destination.path;
  if (destination.is_stream) return;
  const std::filesystem::path temporary = temporary_name(target_);
  const std::scoped_lock lock(unfinished().mutex);
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse_to_write(path, errno);
  ::close(descriptor);
  temporary_ = temporary;
  unfinished().names.insert(temporary);
}

WholeFile::~WholeFile() {
  if (temporary_.empty()) return;
  const std::scoped_lock lock(unfinished().mutex);
  ::unlink(temporary_.c_str());
  unfinished().names.erase(temporary_);
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})) {}

void WholeFile::check(int error) const {
  if (error == 0) return;
  throw WritingFailed(
      fmt::format("{}: writing failed ({})", path_.string(), std::generic_category().message(error)));
}

void WholeFile::write(std::span<const unsigned char> bytes) {
  if (!temporary_.empty()) return check(write_into(temporary_, bytes, true));
  if (!unfinished().permission()) throw Interrupted();
  check(write_into(target_, bytes, false));
}

void WholeFile::take_names(std::span<WholeFile> files, bool asks) {
  std::vector<const WholeFile*> named;
  {
    const std::scoped_lock lock(unfinished().mutex);
    const bool only_streams = std::all_of(files.begin(), files.end(),
                                          [](const WholeFile& file) { return file.temporary_.empty(); });
    if (only_streams) return;
    if (asks && !unfinished().permission()) throw Interrupted();
    for (WholeFile& file : files) {
      if (file.temporary_.empty()) continue;
      file.check(::rename(file.temporary_.c_str(), file.target_.c_str()) == 0 ? 0 : errno);
      unfinished().names.erase(file.temporary_);
      file.temporary_.clear();
      named.push_back(&file);
    }
  }
  for (const WholeFile* file : named) file->check(sync_folder_of(file->target_));
}

void WholeFile::commit(std::span<const unsigned char> bytes) {
  write(bytes);
  take_names({this, 1});
}

void write_whole_file(const std::filesystem::path& path, const std::string& bytes) {
  write_whole_files({{path, bytes}});
}

void keep_whole_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream there;
  there << file.rdbuf();
  if (there.str() != bytes) write_whole_file(path, bytes);
}

void write_note(const std::filesystem::path& path, const std::string& bytes) {
  WholeFile file(path);
  file.write({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  WholeFile::take_names({&file, 1}, false);
}

void write_whole_files(const std::vector<FileText>& texts) {
  std::vector<WholeFile> files;
  for (const FileText& text : texts) files.emplace_back(text.path);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string& bytes = texts[i].bytes;
    files[i].write({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  }
  WholeFile::take_names(files);
}

void link_whole_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  {
    const std::filesystem::path temporary = temporary_name(to);
    const std::scoped_lock lock(unfinished().mutex);
    if (!unfinished().permission()) throw Interrupted();
    std::filesystem::create_hard_link(from, temporary, error);
    if (!error) {
      std::filesystem::rename(temporary, to, error);
      ::unlink(temporary.c_str());  // there still if both were one file already
      if (error) refuse_to_write(to, error.value());
      return;
    }
  }
  std::ifstream file(from, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (!file) throw InputError(fmt::format("{}: cannot be read", from.string()));
  write_whole_file(to, bytes.str());
}

void ask_before_writing(std::function<bool()> permission) {
  const std::scoped_lock lock(unfinished().mutex);
  unfinished().permission = std::move(permission);
}

void abandon_files() {
  unfinished().mutex.lock();
  for (const std::filesystem::path& name : unfinished().names) ::unlink(name.c_str());
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<int> counter{0};
  const std::string name = path.filename().string().substr(0, kLongestName);
  return path.parent_path() / fmt::format(".{}.{}.{}.{}.tmp", name, host_in_names(), getpid(), counter++);
}

void remove_leftovers(const std::filesystem::path& folder) {
  const std::string host = host_in_names();
  std::error_code ignored;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::optional<Writer> writer = writer_of(entry.path().filename().string());
    if (!writer) continue;
    const bool is_dead = writer->host == host && !is_alive(writer->process);
    if (is_dead || is_old(entry.path())) leftovers.push_back(entry.path());
  }
  for (const std::filesystem::path& leftover : leftovers) std::filesystem::remove(leftover, ignored);
}

}  // namespace indet
