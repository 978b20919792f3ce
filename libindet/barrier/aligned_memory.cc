#include "libindet/barrier/aligned_memory.h"

#include <cstring>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace indet::barrier {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{1} << 21;

}  // namespace

AlignedMemory::AlignedMemory(std::size_t bytes) {
  const bool is_large = bytes >= kLargePage / 2;
  const std::size_t alignment = is_large ? kLargePage : kCacheLine;
  const std::size_t size = (bytes / alignment + 1) * alignment;
  start_.reset(static_cast<std::byte*>(std::aligned_alloc(alignment, size)));
  if (!start_) throw std::bad_alloc();
#ifdef __linux__
  // Advice: that it may not be taken is no error. It has to come before the memory is written to.
  if (is_large) madvise(start_.get(), size, MADV_HUGEPAGE);
#endif
  std::memset(start_.get(), 0, size);
}

}  // namespace indet::barrier
