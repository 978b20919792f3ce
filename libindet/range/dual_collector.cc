#include "libindet/range/dual_collector.h"

#include <algorithm>
#include <map>
#include <utility>

#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/polytope/sparse_decision.h"
#include "libindet/range/functional.h"

namespace indet {

DualCollector::DualCollector(const Packing& packing, const ForcePolytope& polytope,
                             const std::vector<int>& contacts)
    : packing_(packing), polytope_(polytope), first_(polytope.natural.first_unknowns()) {
  const EquilibriumProblem& natural = polytope.natural;
  const auto rows = static_cast<Eigen::Index>(3 * natural.disks + 2 * natural.walls + 3) +
                    static_cast<Eigen::Index>(natural.bounds.size());
  natural_of_scene_.assign(static_cast<std::size_t>(rows), -1);
  for (std::size_t k = 0; k < natural.rows.size(); ++k)
    natural_of_scene_[static_cast<std::size_t>(scene_row(natural.rows[k]))] = static_cast<int>(k);
  if (polytope.problem.unknowns() < natural.unknowns()) find_closing();
  const auto count = static_cast<Eigen::Index>(contacts.size());
  duals_.contacts = Eigen::Map<const Eigen::ArrayXi>(contacts.data(), count);
  duals_.multipliers.setZero(4 * count, rows);
  duals_.points.setZero(4 * count, 2 * static_cast<Eigen::Index>(natural.contacts.size()));
  Eigen::VectorXd bounding = natural_motion(polytope.central->centre.y);
  const Eigen::VectorXd along = powers(bounding);
  double share = 0;
  for (const int k : closed_) share = std::max(share, (1 - along[k]) / closing_powers_[k]);
  if (share > 0) bounding += share * closing_;
  duals_.bounding = on_scene_rows(bounding);
}

int DualCollector::scene_row(const EquilibriumRow& row) const {
  const int walls = 3 * polytope_.natural.disks;
  const int cell = walls + 2 * polytope_.natural.walls;
  if (row.bound >= 0) return cell + 3 + row.bound;
  if (row.body.is_cell()) return cell + (row.component == 3 ? 0 : row.component);
  if (row.body.is_wall()) return walls + 2 * row.body.wall_id().value() + row.component;
  return 3 * row.body.disk_id().value() + row.component;
}

Eigen::VectorXd DualCollector::on_natural_rows(std::span<const EquilibriumRow> rows,
                                               const Eigen::VectorXd& y) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(polytope_.natural.equations());
  for (std::size_t k = 0; k < rows.size(); ++k)
    result[natural_of_scene_[static_cast<std::size_t>(scene_row(rows[k]))]] = y[static_cast<Eigen::Index>(k)];
  return result;
}

Eigen::VectorXd DualCollector::natural_motion(const std::vector<double>& y) const {
  return on_natural_rows(polytope_.problem.rows,
                         on_equations(polytope_.problem, polytope_.central->structure, y));
}

Eigen::VectorXd DualCollector::on_scene_rows(const Eigen::VectorXd& natural) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(natural_of_scene_.size()));
  for (Eigen::Index k = 0; k < natural.size(); ++k) {
    const EquilibriumRow& row = polytope_.natural.rows[static_cast<std::size_t>(k)];
    const int place = scene_row(row);
    result[place] += natural[k];
    // s + s′ = hi − lo is the difference of F + s′ = hi and F − s = lo.
    if (row.bound >= 0 && polytope_.natural.bounds[static_cast<std::size_t>(row.bound)].follows_lower())
      result[place - 1] -= natural[k];
  }
  return result;
}

Eigen::VectorXd DualCollector::powers(const Eigen::VectorXd& natural) const {
  return polytope_.natural.edge_matrix.transpose() * natural;
}

void DualCollector::find_closing() {
  const EquilibriumProblem& natural = polytope_.natural;
  const SparseDecision decision = decide_sparsely(packing_);
  is_known_ = decision.decided && decision.problem.unknowns() == polytope_.problem.unknowns();
  if (!is_known_) return;
  std::map<int, int> column_of;
  for (int k = 0; k < natural.unknowns(); ++k) column_of[natural.half_plane(natural.edge(k))] = k;
  // A later motion knows nothing of the edges that were closed before: enough of the earlier one is added.
  closing_.setZero(natural.equations());
  for (auto step = decision.steps.rbegin(); step != decision.steps.rend(); ++step) {
    const Eigen::VectorXd motion = on_natural_rows(step->rows, step->motion);
    const Eigen::VectorXd along = powers(motion);
    const Eigen::VectorXd later = powers(closing_);
    double share = 1;
    for (const int half_plane : step->half_planes) {
      const int k = column_of.at(half_plane);
      closed_.push_back(k);
      share = std::max(share, (1 - later[k]) / along[k]);
    }
    closing_ += share * motion;
  }
  // A step is known to what its iteration left. What power there is along open edges is taken away.
  closing_powers_ = powers(closing_);
  barrier::Objective left;
  for (int k = 0; k < polytope_.problem.unknowns(); ++k) {
    const int column = column_of.at(polytope_.problem.half_plane(polytope_.problem.edge(k)));
    left.emplace_back(k, closing_powers_[column]);
  }
  closing_ -= natural_motion(polytope_.central->equations->nearest_multipliers(left));
  closing_powers_ = powers(closing_);
}

void DualCollector::add(int contact, int column, std::vector<double> x, const std::vector<double>& y) {
  if (!is_known_) return;
  const EquilibriumProblem& problem = polytope_.problem;
  const std::vector<double>& centre = polytope_.central->centre.x;
  const double sign = column == kMaxR || column == kMaxT ? -1 : 1;
  Eigen::VectorXd natural = natural_motion(y);
  Eigen::VectorXd along = powers(natural);
  for (const auto& [k, weight] : force_component(polytope_.natural, first_, contact, column >= kMinT, sign))
    along[k] -= weight;
  double share = 0;
  for (const int k : closed_) share = std::max(share, along[k] / closing_powers_[k]);
  if (share > 0) natural -= 2 * share * closing_;

  if (x.empty()) x = centre;
  double moved = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < 0) moved = std::max(moved, -x[k] / (centre[k] - x[k]));
  }
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += moved * (centre[k] - x[k]);
  const auto d = std::lower_bound(duals_.contacts.begin(), duals_.contacts.end(), contact);
  const Eigen::Index row = Duals::row_of(d - duals_.contacts.begin(), column);
  duals_.multipliers.row(row) = sign * on_scene_rows(natural).transpose();
  const Eigen::Map<const Eigen::VectorXd> strengths(x.data(), static_cast<Eigen::Index>(x.size()));
  duals_.points.row(row) = problem.units.scene(problem.state(strengths)).value().transpose();
}

Duals DualCollector::take() { return is_known_ ? std::move(duals_) : Duals(); }

}  // namespace indet
