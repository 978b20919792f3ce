#include "libindet/polytope/motion_rows.h"

namespace indet {

std::vector<double> motion_on_exact_rows(const exact::ContactProblem& exact,
                                         const EquilibriumProblem& problem, const Eigen::VectorXd& motion) {
  std::vector<double> result(static_cast<std::size_t>(exact.rows()), 0);
  const double largest = motion.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(i)];
    const double velocity = motion[i] / largest;
    if (row.bound >= 0) {
      // Bounds are F − s = lo, F + s = hi there; the row s + s′ = hi − lo is the difference of both.
      result[static_cast<std::size_t>(exact.row_of_bound(row.bound))] += velocity;
      if (problem.bounds[static_cast<std::size_t>(row.bound)].follows_lower())
        result[static_cast<std::size_t>(exact.row_of_bound(row.bound - 1))] -= velocity;
      continue;
    }
    const int number = exact.row(row.body, row.component);
    if (number < 0) continue;
    const bool turns = !row.body.is_cell() && row.component == 2;
    const double scale = row.body.is_cell() ? exact.compression_scale()
                         : turns            ? exact.spin_scale(row.body.disk_id())
                                            : 1;
    result[static_cast<std::size_t>(number)] = velocity * scale;
  }
  return result;
}

ContactMode without_edge(ContactMode mode, int sign) {
  if (mode != ContactMode::kStick) return ContactMode::kOpen;
  return sign > 0 ? ContactMode::kSlideMinus : ContactMode::kSlidePlus;
}

}  // namespace indet
