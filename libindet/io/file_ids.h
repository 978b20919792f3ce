#pragma once

#include <cstdint>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// The ids under which bodies appear in text files: their own where these are all different and none is
/// negative, else their rows. A wall w is written as −(w + 1).
struct FileIds {
  std::vector<std::int32_t> disks, walls;

  explicit FileIds(const Packing& packing);
  std::int32_t of(DiskId disk) const { return disks[static_cast<std::size_t>(disk.value())]; }
  std::int32_t of(Body body) const {
    return body.is_wall() ? -(walls[static_cast<std::size_t>(body.wall_id().value())] + 1)
                          : of(body.disk_id());
  }
};

}  // namespace indet
