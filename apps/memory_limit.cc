#include "apps/memory_limit.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <limits>

#include "libindet/base/error.h"

namespace indet::app {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;
/// What OpenBLAS reserves for each thread that computes; libraries of other makers take less.
constexpr std::size_t kBlasBuffer = 128 * kMegabyte;
/// For everything else in a small analysis.
constexpr std::size_t kRest = 64 * kMegabyte;

/// OpenBLAS starts its threads as soon as it is loaded, and each takes its buffer.
std::size_t blas_threads() {
  using GetThreads = int (*)();
  const auto get_threads = reinterpret_cast<GetThreads>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  return get_threads == nullptr ? 1 : static_cast<std::size_t>(get_threads());
}

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// Free memory and swap of the machine.
std::size_t left_on_machine() {
  std::ifstream file("/proc/meminfo");
  std::size_t kilobytes = 0;
  bool found = false;
  for (std::string name, unit; file >> name;) {
    std::size_t value = 0;
    file >> value;
    std::getline(file, unit);
    if (name != "MemAvailable:" && name != "SwapFree:") continue;
    kilobytes += value;
    found = true;
  }
  return found ? 1024 * kilobytes : kUnlimited;
}

std::size_t limit_of_group() {
  std::ifstream file("/sys/fs/cgroup/memory.max");
  std::size_t bytes = 0;
  return file >> bytes ? bytes : kUnlimited;  // "max" is no number
}

std::size_t left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages;
  const std::size_t used = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}

std::string size_text(std::size_t bytes) {
  const double megabytes = static_cast<double>(bytes) / kMegabyte;
  return megabytes < 1024 ? fmt::format("{:.0f} MB", megabytes) : fmt::format("{:.1f} GB", megabytes / 1024);
}

}  // namespace

void require_memory(std::size_t bytes, const std::string& task) {
  const std::size_t left = std::min({left_on_machine(), limit_of_group(), left_of_address_space()});
  if (bytes <= left) return;
  throw InputError(fmt::format("{} takes about {} of memory, but {} are available", task, size_text(bytes),
                               size_text(left)));
}

std::string lack_of_memory() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  const std::size_t needed = blas_threads() * kBlasBuffer + kRest;
  void* const space = mmap(nullptr, needed, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (space == MAP_FAILED) {
    return fmt::format(
        "out of memory: of the {} MB that are allowed (ulimit -v), less than {} MB are left for linear "
        "algebra; raise the limit",
        limit.rlim_cur / kMegabyte, needed / kMegabyte);
  }
  munmap(space, needed);
  return {};
}

}  // namespace indet::app
