#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <utility>
#include <vector>

namespace indet {

/// A polyhedron of dimension d = K − r in standard form, with K inequalities and r independent equations;
/// sparse:
///
///   x ≥ 0,  equations · x = right_hand_side
///
/// For a packing x are the strengths of the contact cones' edges, and the equations those of equilibrium.
struct FeasibleSet {
  Eigen::SparseMatrix<double> equations;
  Eigen::VectorXd right_hand_side;

  int inequalities() const { return static_cast<int>(equations.cols()); }
  int dim() const { return static_cast<int>(equations.cols() - equations.rows()); }
};

/// The same polyhedron in d coordinates, made by those who need them; dense (K × d numbers):
///
///   x(z) = offset + slope · z ≥ 0,  z ∈ R^d free          (slope of rank d)
///
/// For a packing z are coordinates in the null space of the contact matrix. Auxiliary problems (interior
/// point, recession cone) have this form alone.
struct SlopeView {
  Eigen::MatrixXd slope;
  Eigen::VectorXd offset;
  std::shared_ptr<const FeasibleSet> set;  ///< What it is a view of; null for an auxiliary problem.

  int dim() const { return static_cast<int>(slope.cols()); }
  int inequalities() const { return static_cast<int>(slope.rows()); }
};

/// A linear functional on a polyhedron, in both forms; constant terms are left out.
struct Objective {
  Eigen::VectorXd along_z;                       ///< d: slopeᵀ e
  std::vector<std::pair<int, double>> on_edges;  ///< e: (index into x, coefficient)
};

/// The objective e · x of the given sparse coefficients.
Objective make_objective(const SlopeView& view, std::vector<std::pair<int, double>> on_edges);

/// A vertex, named by d inequalities that hold with equality there and whose rows of `slope` are independent;
/// ascending. This is all that a warm start needs, whatever the formulation.
using Basis = std::vector<int>;

}  // namespace indet
