#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>

#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// The ellipsoid of Dikin about a point of F, from the second derivatives of −Σ log(slack) by the forces F
/// themselves (2 × 2 a contact) and Schur's complement of the equations,
///
///     P = H⁻¹ − H⁻¹cᵀ (cH⁻¹cᵀ)⁻¹ cH⁻¹,     σ_k = √P_kk.
///
/// Forces that are held (T where μ = 0, forces that are given) have no width.
class RebuiltEllipsoid {
 public:
  /// `centre`: forces in force units. None if some half-plane has no more slack there than `least`, or
  /// rounding leaves no factor.
  static std::unique_ptr<const RebuiltEllipsoid> about(const RebuiltProblem& problem,
                                                       const Eigen::VectorXd& centre, double least);

  /// Newton's decrement √(gᵀPg), g = Σ normal/slack: how far the analytic centre is, over the ellipsoid.
  double decrement() const;
  /// σ of component k of the forces (2α: R_α, 2α + 1: T_α), in force units.
  double width(int component) const;

 private:
  RebuiltEllipsoid(const RebuiltProblem& problem, const Eigen::VectorXd& centre);
  double size(const Eigen::VectorXd& vector) const;  ///< √(vᵀPv)

  Eigen::SparseMatrix<double> inverse_;    ///< H⁻¹
  Eigen::SparseMatrix<double> equations_;  ///< c
  Eigen::VectorXd slope_;                  ///< g
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace indet
