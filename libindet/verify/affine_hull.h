#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// The directions in which the polytope F extends. At a point of its relative interior (a mean of states that
/// together use every half-plane's freedom) the half-planes without slack are those that hold with equality
/// everywhere in F, so that
///
///     span D = {D ∈ ker c : normal · D = 0 for each half-plane that is tight there},   dim F = dim span D.
class AffineHull {
 public:
  /// `interior`: forces in force units. None if it is not clear which half-planes are tight there: some
  /// slack, relative to the largest force, lies between rounding and what is clearly more.
  static std::optional<AffineHull> at(const RebuiltProblem& problem, const Eigen::VectorXd& interior);

  int dim() const { return static_cast<int>(directions_.cols()); }
  /// 2M × dim F, orthonormal.
  const Eigen::MatrixXd& directions() const { return directions_; }

  /// How far component k of the forces (2α: R_α, 2α + 1: T_α) moves along a unit direction, at most. 0 means
  /// that it is determined.
  double freedom(int component) const { return directions_.row(component).norm(); }
  /// False if `freedom` of some component is neither rounding nor clearly more.
  bool freedom_is_clear() const;

  /// The number of independent parts of F. Write the slacks of all half-planes as combinations of dim F
  /// independent ones among them; two half-planes belong together if a chain of non-zero coefficients or a
  /// common contact joins them. None if some coefficient is neither rounding nor clearly more.
  std::optional<int> blocks() const;

 private:
  AffineHull(Eigen::MatrixXd directions, Eigen::MatrixXd slopes)
      : directions_(std::move(directions)), slopes_(std::move(slopes)) {}

  Eigen::MatrixXd directions_;
  Eigen::MatrixXd slopes_;  ///< 2M × dim F: of the half-planes along the directions
};

}  // namespace indet
