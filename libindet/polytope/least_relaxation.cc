#include "libindet/polytope/least_relaxation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/polytope/interior.h"

namespace indet {
namespace {

Packing without_bounds(Packing packing) {
  for (Contact& contact : packing.contacts) {
    contact.R_lo = contact.T_lo = -std::numeric_limits<double>::infinity();
    contact.R_hi = contact.T_hi = std::numeric_limits<double>::infinity();
  }
  return packing;
}

/// The smallest half interval: t is found in units of it, so that the solver's tolerances do not hide it.
double smallest_error(const std::vector<ForceBound>& bounds, double unit) {
  double smallest = 1;
  for (const ForceBound& bound : bounds) smallest = std::min(smallest, bound.half_interval() / unit);
  return smallest;
}

}  // namespace

std::optional<double> least_relaxation(const Packing& packing, const LpOptions& options) {
  const std::vector<ForceBound> bounds = force_bounds(packing);
  if (bounds.empty()) return 0;
  const ForcePolytope polytope = find_force_polytope(without_bounds(packing), options);
  if (polytope.status == PolytopeStatus::kEmpty) return {};
  const EquilibriumProblem& problem = polytope.problem;
  const double unit = problem.units.internal_in_scene();
  const double size = smallest_error(bounds, unit);

  // (z, t): x ≥ 0 of the polytope, then the bounds, then t ≥ 0.
  const Eigen::MatrixXd to_forces = problem.edge_forces;
  const Eigen::MatrixXd slope = problem.to_edges * polytope.null_space->basis;
  const int d = static_cast<int>(slope.cols());
  const auto edges = static_cast<Eigen::Index>(slope.rows());
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> offsets;
  const Eigen::VectorXd& inside = polytope.dim == 0 ? polytope.lightest : polytope.interior;
  const auto add = [&](const ForceBound& bound, double sign) {
    const Eigen::RowVectorXd force = to_forces.row(bound.component());
    Eigen::VectorXd row(d + 1);
    row << sign / size * (force * slope).transpose(), 1;
    rows.push_back(std::move(row));
    offsets.push_back(sign * (force.dot(inside) - bound.value / unit) / size);
  };
  for (const ForceBound& bound : bounds) {
    if (bound.side != ForceBound::Side::kUpper) add(bound, 1);
    if (bound.side != ForceBound::Side::kLower) add(bound, -1);
  }
  const auto count = edges + static_cast<Eigen::Index>(rows.size()) + 1;
  SlopeView view;
  view.slope = Eigen::MatrixXd::Zero(count, d + 1);
  view.offset = Eigen::VectorXd::Zero(count);
  view.slope.topLeftCorner(edges, d) = slope;
  view.offset.head(edges) = inside;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    view.slope.row(edges + static_cast<Eigen::Index>(k)) = rows[k].transpose();
    view.offset[edges + static_cast<Eigen::Index>(k)] = offsets[k];
  }
  view.slope(count - 1, d) = 1;

  Eigen::VectorXd origin = Eigen::VectorXd::Zero(d + 1);
  origin[d] = std::max(0.0, -*std::min_element(offsets.begin(), offsets.end()));
  const Objective tightest = make_objective(view, {{static_cast<int>(count) - 1, -1.0}});
  const Basis start = purify_to_vertex(view, origin, tightest.along_z);
  const LpAnswer answer = maximise_robustly(view, tightest, start, options);
  if (answer.status != LpStatus::kOptimal)
    throw LibraryError("the linear program for the least error of the bounds could not be solved");
  const double t = std::max(0.0, compute_vertex(view, answer.basis).z[d]) * size;
  return t * unit / packing.force_unit();
}

}  // namespace indet
