#pragma once

#include <Eigen/Core>

namespace indet {

struct CentralPolytope;
struct EquilibriumProblem;
struct ForcePolytope;

/// The analytic centre of F as forces, and how far each of them reaches from it within the Dikin ellipsoid
/// (barrier/dikin_widths.h).
struct CentralWidths {
  /// [M, 2], R and T of the centre and their widths σ, in the scene's unit of force; no rows where they are
  /// not known.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> centre, width;
};

CentralWidths central_widths(const EquilibriumProblem& problem, const CentralPolytope& central);
/// Precondition: polytope.central.
CentralWidths central_widths(const ForcePolytope& polytope);

}  // namespace indet
