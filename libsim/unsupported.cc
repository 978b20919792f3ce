#include "libsim/unsupported.h"

#include <fmt/format.h>

#include "libindet/base/error.h"
#include "libindet/packing/force_bounds.h"

namespace indet::sim {

void refuse_unsupported(const Packing& packing, const char* what) {
  const auto refuse = [&](const std::string& reason, const char* these) {
    throw InputError(
        fmt::format("{} {}; ranges, and samples with --method uniform, take {}", what, reason, these));
  };
  if (packing.cell.is_periodic())
    refuse("takes no periodic scenes, and this one has a cell", "periodic cells");
  if (!force_bounds(packing).empty())
    refuse("keeps to no bounds of forces (R_lo, R_hi, T_lo, T_hi), and this packing has some", "bounds");
  for (const Wall& wall : packing.walls) {
    if (!wall.is_loaded()) continue;
    refuse(fmt::format("takes fixed walls only, but wall {} is loaded (load_n, load_t)", wall_name(wall)),
           "loaded walls");
  }
}

}  // namespace indet::sim
