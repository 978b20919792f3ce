#include "libindet/verify/motion_check.h"

#include <fmt/format.h>

#include <cmath>

#include "libindet/base/tolerances.h"
#include "libindet/verify/cell_motion_check.h"

namespace indet {

void check_motion(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  Comparisons& compare) {
  if (!compare.require(ranges.motion.rows() == packing.disk_count(), "motion: {} rows for {} disks",
                       ranges.motion.rows(), packing.disk_count())) {
    return;
  }
  for (int i = 0; i < packing.disk_count(); ++i) {
    compare.require(!packing[DiskId(i)].fixed || ranges.motion.row(i).isZero(0),
                    "motion: disk {} is fixed, but moves", packing[DiskId(i)].id);
  }
  const bool walls_move = ranges.wall_motion.rows() > 0;
  if (!compare.require(!walls_move || ranges.wall_motion.rows() == packing.wall_count(),
                       "wall_motion: {} rows for {} walls", ranges.wall_motion.rows(),
                       packing.wall_count())) {
    return;
  }
  for (int w = 0; walls_move && w < packing.wall_count(); ++w) {
    const Wall& wall = packing[WallId(w)];
    const bool is_held = (std::isnan(wall.load_n) && ranges.wall_motion(w, 0) != 0) ||
                         (std::isnan(wall.load_t) && ranges.wall_motion(w, 1) != 0);
    compare.require(!is_held, "wall_motion: wall {} moves where it is not free", wall.id);
  }
  if (!check_cell_motion(packing, ranges, compare)) return;
  const Eigen::VectorXd motion = problem.flat_motion(ranges.motion, ranges.wall_motion, ranges.cell_motion);
  const auto bounds = static_cast<Eigen::Index>(force_bounds(packing).size());
  if (!compare.require(ranges.bound_multipliers.size() == bounds, "bound_multipliers: {} for {} bounds",
                       ranges.bound_multipliers.size(), bounds)) {
    return;
  }
  const double power = problem.load_power(motion) + problem.bounds_power(ranges.bound_multipliers);
  const double resisted = problem.smallest_power(motion, ranges.bound_multipliers);
  compare.require(power > 0, "motion: the load does no work ({})", power);
  compare.require(resisted >= -tolerance::kResistedMotion, "motion: some contact resists it ({})", resisted);
}

}  // namespace indet
