#include "libsim/periodic_cell.h"

#include <fmt/format.h>

#include "libindet/base/error.h"

namespace indet::sim {

void refuse_periodic_cell(const Packing& packing, const char* what) {
  if (!packing.cell.is_periodic()) return;
  throw InputError(
      fmt::format("{} takes no periodic scenes, and this one has a cell; ranges, and samples with --method "
                  "uniform, take periodic cells",
                  what));
}

}  // namespace indet::sim
