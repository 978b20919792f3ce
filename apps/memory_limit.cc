#include "apps/memory_limit.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>

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

}  // namespace

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
