#include "libindet/verify/cell_motion_check.h"

#include <cmath>

namespace indet {

bool check_cell_motion(const Packing& packing, const ForceRanges& ranges, Comparisons& compare) {
  if (ranges.cell_motion.rows() == 0) return true;
  const Stress& stress = packing.stress;
  if (!compare.require(ranges.cell_motion.rows() == 2 && stress.is_imposed(),
                       "cell_motion: {} rows for a cell {} imposed stress", ranges.cell_motion.rows(),
                       stress.is_imposed() ? "with" : "without"))
    return false;
  const Eigen::Matrix2d rate = ranges.cell_motion;
  const bool isotropic = !std::isnan(stress.pressure);
  const bool is_held = (!isotropic && std::isnan(stress.xx) && rate(0, 0) != 0) ||
                       (!isotropic && std::isnan(stress.yy) && rate(1, 1) != 0) ||
                       (isotropic && rate(0, 0) != rate(1, 1)) ||
                       (std::isnan(stress.xy) && rate(0, 1) != 0) || rate(1, 0) != 0;
  return compare.require(!is_held, "cell_motion: the cell deforms where no stress is imposed");
}

}  // namespace indet
