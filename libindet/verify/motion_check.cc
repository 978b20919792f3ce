#include "libindet/verify/motion_check.h"

#include <fmt/format.h>

#include <cmath>

#include "libindet/base/tolerances.h"
#include "libindet/exact/body_motion.h"
#include "libindet/exact/certificate.h"
#include "libindet/verify/cell_motion_check.h"

namespace indet {
namespace {

/// Aᵀ y ≥ 0 and b·y < 0 by more than sums can be wrong: no motion that rests at some contact.
bool is_clear(const RebuiltProblem& problem, const Eigen::VectorXd& y) {
  bool clear = true;
  problem.for_each_edge(y, [&](int, double, double, const RebuiltProblem::Sum& along) {
    clear = clear && along.value >= tolerance::kSumOfProof * along.size;
  });
  const RebuiltProblem::Sum load = problem.load_product(y);
  return clear && load.value < -tolerance::kSumOfProof * load.size;
}

bool is_exact(const Packing& packing, const ForceRanges& ranges) {
  const exact::ContactProblem problem(packing);
  const exact::BodyMotion motion{ranges.motion, ranges.wall_motion, ranges.cell_motion,
                                 ranges.bound_multipliers};
  return exact::proves_emptiness(problem, exact::on_rows(packing, problem, motion), tolerance::kExactZero);
}

/// That the motion proves what the file says. Of an outcome in doubt nothing is said.
void check_proof(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                 const ExactAnswers& exact, const Eigen::VectorXd& motion, Comparisons& compare) {
  Eigen::VectorXd y(problem.scene_rows());
  y << motion, ranges.bound_multipliers;
  if (is_clear(problem, y)) return;
  if (ranges.unknowns > tolerance::kMostForPrograms) {
    compare.leave_unchecked(
        "that no contact at all resists the motion (it rests at some, and the packing is large)");
    return;
  }
  compare.require(is_exact(packing, ranges) || exact.agree_on_emptiness(),
                  "motion: no exact motion near to it proves that the packing cannot stand");
}

}  // namespace

void check_motion(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  const ExactAnswers& exact, Comparisons& compare) {
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
  if (ranges.doubtful) return compare.leave_unchecked("motion (the outcome is in doubt)");
  const bool falls = compare.require(power > 0, "motion: the load does no work ({})", power);
  if (compare.require(resisted >= -tolerance::kResistedMotion, "motion: some contact resists it ({})",
                      resisted) &&
      falls)
    check_proof(packing, ranges, problem, exact, motion, compare);
}

}  // namespace indet
