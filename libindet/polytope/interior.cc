#include "indet/polytope/interior.h"

#include <algorithm>

#include "indet/base/error.h"
#include "indet/base/tolerances.h"
#include "indet/lp/vertex.h"
#include "indet/lp/walk.h"

namespace indet {

InteriorPoint find_interior_point(const FeasibleSet& set, const LpOptions& options) {
  const int d = set.dim();
  const int count = set.inequalities();
  InteriorPoint result;
  result.multipliers = Eigen::VectorXd::Zero(count);
  if (count == 0) {
    result.slack = 1;
    result.z = Eigen::VectorXd::Zero(d);
    return result;
  }
  // (z, t) with x − t ≥ 0 and 1 − t ≥ 0.
  FeasibleSet lifted;
  lifted.slope = Eigen::MatrixXd::Zero(count + 1, d + 1);
  lifted.slope.topLeftCorner(count, d) = set.slope;
  lifted.slope.col(d).setConstant(-1);
  lifted.offset.resize(count + 1);
  lifted.offset << set.offset, 1;
  Objective height;
  height.along_z = Eigen::VectorXd::Unit(d + 1, d);

  LpSolver solver(lifted, Formulation::kDual, options);
  Eigen::VectorXd origin = Eigen::VectorXd::Zero(d + 1);
  origin[d] = std::min(1.0, set.offset.minCoeff());
  const LpAnswer answer = solver.maximise(height, walk_to_vertex(lifted, origin, height.along_z));
  result.pivots = answer.pivots;
  if (answer.status != LpStatus::kOptimal) {
    throw LibraryError("the linear program for an interior point could not be solved");
  }
  const Vertex vertex = compute_vertex(lifted, answer.basis);
  result.z = vertex.z.head(d);
  result.slack = vertex.z[d];
  const Eigen::VectorXd multipliers = vertex.multipliers(height.along_z);
  for (int i = 0; i <= d; ++i) {
    const int k = vertex.basis[static_cast<std::size_t>(i)];
    if (k < count) result.multipliers[k] = std::max(0.0, multipliers[i]);
  }
  return result;
}

FeasibleSet truncated_recession_cone(const FeasibleSet& set) {
  const int count = set.inequalities();
  FeasibleSet cone;
  cone.slope.resize(count + 1, set.dim());
  cone.slope << set.slope, -set.slope.colwise().sum();
  cone.offset = Eigen::VectorXd::Unit(count + 1, count);
  return cone;
}

Eigen::VectorXd find_recession_ray(const FeasibleSet& set, const LpOptions& options, std::int64_t& pivots) {
  const FeasibleSet cone = truncated_recession_cone(set);
  Objective total;
  total.along_z = set.slope.colwise().sum().transpose();
  LpSolver solver(cone, Formulation::kNullSpace, options);
  const LpAnswer answer =
      solver.maximise(total, walk_to_vertex(cone, Eigen::VectorXd::Zero(set.dim()), total.along_z));
  pivots += answer.pivots;
  if (answer.status != LpStatus::kOptimal) {
    throw LibraryError("the linear program for a recession ray could not be solved");
  }
  const Vertex vertex = compute_vertex(cone, answer.basis);
  if (vertex.z.dot(total.along_z) < 0.5) return {};
  return vertex.x.head(set.inequalities());
}

}  // namespace indet
