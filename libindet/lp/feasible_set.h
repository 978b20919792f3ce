#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <utility>
#include <vector>

namespace indet {

/// A polyhedron in R^d, described twice (K inequalities, d dimensions):
///
///   explicit:  x(z) = offset + slope · z ≥ 0,  z ∈ R^d free          (slope: K × d, of rank d)
///   implicit:  x ≥ 0,  equations · x = right_hand_side                (r = K − d independent rows; sparse;
///   may be left empty)
///
/// For a packing x are the strengths of the contact cones' edges, and z coordinates in the null space of the
/// contact matrix. The same form serves for auxiliary problems (interior point, recession cone).
struct FeasibleSet {
  Eigen::MatrixXd slope;
  Eigen::VectorXd offset;
  Eigen::SparseMatrix<double> equations;
  Eigen::VectorXd right_hand_side;

  int dim() const { return static_cast<int>(slope.cols()); }
  int inequalities() const { return static_cast<int>(slope.rows()); }
};

/// A linear functional on a FeasibleSet, in both descriptions; constant terms are left out.
struct Objective {
  Eigen::VectorXd along_z;                       ///< d: slopeᵀ e
  std::vector<std::pair<int, double>> on_edges;  ///< e: (index into x, coefficient)
};

/// The objective e · x of the given sparse coefficients.
Objective make_objective(const FeasibleSet& set, std::vector<std::pair<int, double>> on_edges);

/// A vertex, named by d inequalities that hold with equality there and whose rows of `slope` are independent;
/// ascending. This is all that a warm start needs, whatever the formulation.
using Basis = std::vector<int>;

}  // namespace indet
