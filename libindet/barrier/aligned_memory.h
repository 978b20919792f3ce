#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace indet::barrier {

/// Memory of zeros that starts at the bound of a cache line. Where it is large, it is on large pages if the
/// system has them to give: what is walked through from end to end in each step would else take longer to
/// address than to read.
class AlignedMemory {
 public:
  explicit AlignedMemory(std::size_t bytes);
  std::byte* data() { return start_.get(); }
  const std::byte* data() const { return start_.get(); }

 private:
  struct Free {
    void operator()(std::byte* start) const { std::free(start); }
  };
  std::unique_ptr<std::byte, Free> start_;
};

}  // namespace indet::barrier
