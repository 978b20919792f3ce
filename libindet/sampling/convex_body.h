#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// Rows and columns of a part of a body that shares neither with any other part.
struct BodyBlock {
  Eigen::Index first_row = 0, rows = 0;
  Eigen::Index first_column = 0, columns = 0;
};

/// A bounded polytope with an interior, {z ∈ R^n : offset + slope z ≥ 0}, in coordinates in which lengths and
/// volumes are those of the space of contact states:
///
///   F = origin + frame z,  frameᵀ frame = 1        (frame: 2M × n; forces, and so z, in the internal unit)
///
/// so that the uniform distribution of z is the flat measure on the affine hull of the polytope F [19], and
/// n = dim F. Blocks of F are blocks here; forces that are determined are constant.
struct ConvexBody {
  SlopeView view;
  std::vector<BodyBlock> blocks;
  Eigen::VectorXd origin;  ///< 2M
  Eigen::MatrixXd frame;   ///< 2M × n
  ForceUnits units;        ///< from the internal unit to others

  /// The contact states at z, n × K: 2M × K.
  InternalStates states(const Eigen::Ref<const Eigen::MatrixXd>& z) const;
  int dim() const { return view.dim(); }
  /// How far z is inside: min (offset + slope z), recomputed from z.
  double slack(const Eigen::Ref<const Eigen::VectorXd>& z) const;
};

/// The body of a set given directly: orthonormal coordinates, one block, F = z, all units of force the same.
ConvexBody make_body(const SlopeView& view);

/// The body of the contact states of a packing. Precondition: status is kBounded.
ConvexBody make_body(const ForcePolytope& polytope);

/// The largest ball in the body, in the units of z. Throws LibraryError if its linear program fails.
struct InscribedBall {
  Eigen::VectorXd center;
  double radius = -1;
};
InscribedBall find_inscribed_ball(const ConvexBody& body);

/// The analytic centre: the point that maximises Σ log s, s = offset + slope z, by Newton's method from an
/// interior point. It, and the Dikin ellipsoid {‖root (y − z)‖ ≤ 1}, which lies in the body, follow every
/// affine map of the body. The Hessian Σ a aᵀ/s² = rootᵀ root is never formed, so that bodies may be 1e10
/// times as long as they are wide.
struct AnalyticCenter {
  Eigen::VectorXd z;
  Eigen::MatrixXd root;  ///< n × n, lower triangular with a positive diagonal; block diagonal as the body
};
/// Precondition: body.slack(interior) > 0.
AnalyticCenter find_analytic_center(const ConvexBody& body, const Eigen::VectorXd& interior);

}  // namespace indet
