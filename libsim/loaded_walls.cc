#include "libsim/loaded_walls.h"

#include <fmt/format.h>

#include "libindet/base/error.h"

namespace indet::sim {

void refuse_loaded_walls(const Packing& packing, const char* what) {
  if (packing.has_bounds()) {
    throw InputError(
        fmt::format("{} keeps to no bounds of forces (R_lo, R_hi, T_lo, T_hi), which this packing has; "
                    "ranges, and samples with --method uniform, do",
                    what));
  }
  for (const Wall& wall : packing.walls) {
    if (!wall.is_loaded()) continue;
    throw InputError(
        fmt::format("{} takes fixed walls only, but wall {} is loaded (load_n, load_t); ranges, and samples "
                    "with --method uniform, take loaded walls",
                    what, wall.name.empty() ? fmt::format("{}", wall.id) : wall.name));
  }
}

}  // namespace indet::sim
