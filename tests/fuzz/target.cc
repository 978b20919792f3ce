#include "tests/fuzz/target.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace indet::fuzz {
namespace {

/// Removed at exit.
struct Folder {
  Folder() {
    const bool has_memory = ::access("/dev/shm", W_OK) == 0;
    std::string name = std::string(has_memory ? "/dev/shm" : "/tmp") + "/indet_fuzz_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path path;
};

}  // namespace

const std::filesystem::path& folder() {
  static const Folder folder;
  return folder.path;
}

std::filesystem::path write(const std::string& name, std::string_view bytes) {
  std::filesystem::path path = folder() / name;
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

std::vector<std::string_view> parts(std::string_view bytes) {
  constexpr std::string_view kSeparator = "=====\n";
  std::vector<std::string_view> result;
  for (;;) {
    const std::size_t at = bytes.find(kSeparator);
    result.push_back(bytes.substr(0, at));
    if (at == std::string_view::npos) return result;
    bytes.remove_prefix(at + kSeparator.size());
  }
}

std::pair<std::filesystem::path, std::filesystem::path> write_two(std::string_view bytes,
                                                                  const std::string& first,
                                                                  const std::string& second) {
  const auto both = parts(bytes);
  return {write(first, both[0]), write(second, both.size() > 1 ? both[1] : std::string_view())};
}

}  // namespace indet::fuzz
