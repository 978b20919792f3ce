#include "libindet/exact/body_motion.h"

#include <algorithm>
#include <array>

#include "libindet/packing/cell.h"
#include "libindet/packing/force_bounds.h"

namespace indet::exact {

BodyMotion on_bodies(const Packing& packing, const ContactProblem& problem, std::span<const double> rows) {
  const auto velocity = [&](Body body, int component) {
    const int row = problem.row(body, component);
    return row < 0 ? 0 : rows[static_cast<std::size_t>(row)];
  };
  BodyMotion motion;
  motion.disks.setZero(packing.disk_count(), 3);
  for (int i = 0; i < packing.disk_count(); ++i) {
    const DiskId disk(i);
    for (int k = 0; k < 3; ++k)
      motion.disks(i, k) = velocity(Body::disk(disk), k) / (k == 2 ? problem.spin_scale(disk) : 1);
  }
  const bool walls_move = std::any_of(packing.walls.begin(), packing.walls.end(),
                                      [](const Wall& wall) { return wall.is_loaded(); });
  motion.walls.setZero(walls_move ? packing.wall_count() : 0, 2);
  for (int w = 0; w < motion.walls.rows(); ++w) {
    for (int k = 0; k < 2; ++k) motion.walls(w, k) = velocity(Body::wall(WallId(w)), k);
  }
  if (packing.stress.is_imposed()) {
    std::array<double, 4> rates{};
    for (std::size_t k = 0; k < rates.size(); ++k)
      rates[k] = velocity(Body::cell(), static_cast<int>(k)) / problem.compression_scale();
    motion.cell = compression(rates);
  }
  motion.bounds.resize(static_cast<Eigen::Index>(force_bounds(packing).size()));
  for (Eigen::Index k = 0; k < motion.bounds.size(); ++k)
    motion.bounds[k] = rows[static_cast<std::size_t>(problem.row_of_bound(static_cast<int>(k)))];
  return motion;
}

std::vector<double> on_rows(const Packing& packing, const ContactProblem& problem, const BodyMotion& motion) {
  std::vector<double> rows(static_cast<std::size_t>(problem.rows()), 0);
  const auto set = [&](Body body, int component, double velocity) {
    const int row = problem.row(body, component);
    if (row >= 0) rows[static_cast<std::size_t>(row)] = velocity;
  };
  for (int i = 0; i < packing.disk_count(); ++i) {
    const DiskId disk(i);
    for (int k = 0; k < 3; ++k)
      set(Body::disk(disk), k, motion.disks(i, k) * (k == 2 ? problem.spin_scale(disk) : 1));
  }
  for (int w = 0; w < motion.walls.rows(); ++w) {
    for (int k = 0; k < 2; ++k) set(Body::wall(WallId(w)), k, motion.walls(w, k));
  }
  if (motion.cell.rows() == 2) {
    // One multiplier stands for both diagonal entries where the pressure is imposed.
    const std::array<double, 4> rates{motion.cell(0, 0), motion.cell(1, 1), motion.cell(0, 1),
                                      motion.cell(0, 0) + motion.cell(1, 1)};
    for (std::size_t k = 0; k < rates.size(); ++k)
      set(Body::cell(), static_cast<int>(k), rates[k] * problem.compression_scale());
  }
  for (Eigen::Index k = 0; k < motion.bounds.size(); ++k)
    rows[static_cast<std::size_t>(problem.row_of_bound(static_cast<int>(k)))] = motion.bounds[k];
  return rows;
}

}  // namespace indet::exact
