#include "libindet/polytope/interior.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"

namespace indet {
namespace {

/// Offsets are multiplied by this for the solver, whose tolerances are partly absolute: so parts of a packing
/// that are much lighter than the mean are still seen.
constexpr double kMagnification = 1e4;

/// `set` with one unknown more, ≥ 0, which enters its equations by `column`.
FeasibleSet with_column(const FeasibleSet& set, const Eigen::VectorXd& column) {
  FeasibleSet result;
  result.equations.resize(set.equations.rows(), set.equations.cols() + 1);
  result.equations.leftCols(set.equations.cols()) = set.equations;
  result.equations.rightCols(1) = column.sparseView();
  return result;
}

/// x' = m x − t and s = m − t: A x' − (A 1) s = m (b − A 1).
std::shared_ptr<const FeasibleSet> lifted_set(const FeasibleSet& set) {
  const Eigen::VectorXd sums = set.equations * Eigen::VectorXd::Ones(set.equations.cols());
  FeasibleSet lifted = with_column(set, -sums);
  lifted.right_hand_side = kMagnification * (set.right_hand_side - sums);
  return std::make_shared<const FeasibleSet>(std::move(lifted));
}

/// A x = 0, Σx + s = 1.
std::shared_ptr<const FeasibleSet> cone_set(const FeasibleSet& set) {
  const Eigen::Index rows = set.equations.rows();
  const Eigen::Index columns = set.equations.cols();
  Eigen::SparseMatrix<double, Eigen::RowMajor> equations(rows + 1, columns + 1);
  equations.topRows(rows) = with_column(set, Eigen::VectorXd::Zero(rows)).equations;
  equations.bottomRows(1) = Eigen::RowVectorXd::Ones(columns + 1).sparseView();
  FeasibleSet cone{equations, Eigen::VectorXd::Unit(rows + 1, rows)};
  return std::make_shared<const FeasibleSet>(std::move(cone));
}

}  // namespace

Formulation choose_formulation_of_one(const SlopeView& view) {
  return view.set && view.dim() >= kFewestForEquations ? Formulation::kEdge : Formulation::kDual;
}

LpAnswer maximise_robustly(const SlopeView& view, const Objective& objective, const Basis& start,
                           const LpOptions& options) {
  LpAnswer answer = LpSolver(view, choose_formulation_of_one(view), options).maximise(objective, start);
  if (answer.status == LpStatus::kOptimal) return answer;
  const std::int64_t pivots = answer.pivots;
  answer = LpSolver(view, Formulation::kNullSpace, options).maximise(objective, start);
  answer.pivots += pivots;
  return answer;
}

InteriorPoint find_interior_point(const SlopeView& view, const LpOptions& options) {
  const int d = view.dim();
  const int count = view.inequalities();
  InteriorPoint result;
  result.multipliers = Eigen::VectorXd::Zero(count);
  if (count == 0) {
    result.slack = 1;
    result.z = Eigen::VectorXd::Zero(d);
    return result;
  }
  // (z, t) with x − t ≥ 0 and 1 − t ≥ 0.
  SlopeView lifted;
  lifted.slope = Eigen::MatrixXd::Zero(count + 1, d + 1);
  lifted.slope.topLeftCorner(count, d) = view.slope;
  lifted.slope.col(d).setConstant(-1);
  lifted.offset.resize(count + 1);
  lifted.offset << kMagnification * view.offset, kMagnification;
  if (view.set && d >= kFewestForEquations) lifted.set = lifted_set(*view.set);
  const Objective height{Eigen::VectorXd::Unit(d + 1, d), {{count, -1.0}}};

  Eigen::VectorXd origin = Eigen::VectorXd::Zero(d + 1);
  origin[d] = lifted.offset.minCoeff();
  const Basis start = purify_to_vertex(lifted, origin, height.along_z);
  const LpAnswer answer = maximise_robustly(lifted, height, start, options);
  const bool solved = answer.status == LpStatus::kOptimal;
  result.pivots = answer.pivots;
  // Any point with t > 0 is as good as the optimum; the walk may have found one where the solver gave up.
  const Vertex vertex = compute_vertex(lifted, solved ? answer.basis : start);
  if (!solved && !(vertex.z[d] > 0))
    throw LibraryError("the linear program for an interior point could not be solved");
  result.z = vertex.z.head(d) / kMagnification;
  result.slack = vertex.z[d] / kMagnification;
  result.infeasibility = vertex.infeasibility() / kMagnification;
  if (!solved) return result;
  const Eigen::VectorXd multipliers = vertex.multipliers(height);
  for (int i = 0; i <= d; ++i) {
    const int k = vertex.basis[static_cast<std::size_t>(i)];
    if (k < count) result.multipliers[k] = std::max(0.0, multipliers[i]);
  }
  return result;
}

SlopeView truncated_recession_cone(const SlopeView& view) {
  const int count = view.inequalities();
  SlopeView cone;
  cone.slope.resize(count + 1, view.dim());
  cone.slope << view.slope, -view.slope.colwise().sum();
  cone.offset = Eigen::VectorXd::Unit(count + 1, count);
  if (view.set && view.dim() >= kFewestForEquations) cone.set = cone_set(*view.set);
  return cone;
}

RecessionRay find_recession_ray(const SlopeView& view, const LpOptions& options) {
  const SlopeView cone = truncated_recession_cone(view);
  Objective total;
  total.along_z = view.slope.colwise().sum().transpose();
  for (int k = 0; k < view.inequalities(); ++k) total.on_edges.emplace_back(k, 1.0);
  const Basis start = purify_to_vertex(cone, Eigen::VectorXd::Zero(view.dim()), total.along_z);
  const LpAnswer answer = maximise_robustly(cone, total, start, options);
  if (answer.status != LpStatus::kOptimal)
    throw LibraryError("the linear program for a recession ray could not be solved");
  const Vertex vertex = compute_vertex(cone, answer.basis);
  RecessionRay ray;
  ray.pivots = answer.pivots;
  if (vertex.z.dot(total.along_z) < 0.5) {
    const Eigen::VectorXd costs = vertex.multipliers(total);
    ray.multipliers.setZero(view.inequalities());
    for (Eigen::Index k = 0; k < costs.size(); ++k) {
      const int inequality = vertex.basis[static_cast<std::size_t>(k)];
      if (inequality < view.inequalities()) ray.multipliers[inequality] = std::max(0.0, costs[k]);
    }
    return ray;
  }
  ray.x = vertex.x.head(view.inequalities());
  ray.infeasibility = vertex.infeasibility();
  ray.noise =
      std::max(tolerance::kNoise, 10 * std::numeric_limits<double>::epsilon() / vertex.active.rcond());
  return ray;
}

}  // namespace indet
