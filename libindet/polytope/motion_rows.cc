#include "libindet/polytope/motion_rows.h"

#include "libindet/exact/body_motion.h"

namespace indet {
namespace {

/// What a multiplier of one row says about bounds written as F − s = lo, F + s = hi: the row s + s′ = hi − lo
/// is the difference of both.
template <class Add>
void add_multiplier(const EquilibriumProblem& problem, int bound, double value, Add add) {
  add(bound, value);
  if (problem.bounds[static_cast<std::size_t>(bound)].follows_lower()) add(bound - 1, -value);
}

}  // namespace

Eigen::VectorXd on_equations(const EquilibriumProblem& problem, const barrier::BlockStructure& structure,
                             std::span<const double> y) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(problem.equations());
  for (std::size_t i = 0; i < y.size(); ++i) {
    const int equation = structure.equation_of_place()[i];
    if (equation >= 0) result[equation] = y[i];
  }
  return result;
}

void set_motion(const Packing& packing, const exact::ContactProblem& exact, std::span<const double> rows,
                ForcePolytope& polytope) {
  const exact::BodyMotion motion = exact::on_bodies(packing, exact, rows);
  polytope.motion = motion.disks;
  polytope.wall_motion = motion.walls;
  polytope.cell_motion = motion.cell;
  polytope.bound_multipliers = motion.bounds;
}

double exact_row_scale(const exact::ContactProblem& exact, const EquilibriumRow& row) {
  if (row.body.is_cell()) return exact.compression_scale();
  return row.component == 2 ? exact.spin_scale(row.body.disk_id()) : 1;
}

std::vector<double> motion_on_exact_rows(const exact::ContactProblem& exact,
                                         const EquilibriumProblem& problem, const Eigen::VectorXd& motion) {
  std::vector<double> result(static_cast<std::size_t>(exact.rows()), 0);
  const double largest = motion.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(i)];
    const double velocity = motion[i] / largest;
    if (row.bound >= 0) {
      add_multiplier(problem, row.bound, velocity, [&](int bound, double value) {
        result[static_cast<std::size_t>(exact.row_of_bound(bound))] += value;
      });
      continue;
    }
    const int number = exact.row(row.body, row.component);
    if (number < 0) continue;
    result[static_cast<std::size_t>(number)] = velocity * exact_row_scale(exact, row);
  }
  return result;
}

ContactMode without_edge(ContactMode mode, int sign) {
  if (mode != ContactMode::kStick) return ContactMode::kOpen;
  return sign > 0 ? ContactMode::kSlideMinus : ContactMode::kSlidePlus;
}

}  // namespace indet
