#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libindet/base/random.h"
#include "libindet/sampling/convex_body.h"

namespace indet {

/// Affine coordinates y of a body, z = center + transform y, in which it is about as wide in every direction.
struct Rounding {
  Eigen::VectorXd center;
  Eigen::MatrixXd transform;  ///< n × n lower triangular with a positive diagonal; block diagonal as the body

  double log_determinant() const { return transform.diagonal().array().log().sum(); }
};

/// A body in rounded coordinates: {y : offset + slope y ≥ 0}.
struct RoundedBody {
  Eigen::MatrixXd slope;  ///< K × n; a column is zero outside of the rows of its block
  Eigen::VectorXd offset;
  std::vector<BodyBlock> block_of_column;

  RoundedBody(const ConvexBody& body, const Rounding& rounding);
  int dim() const { return static_cast<int>(slope.cols()); }
};

/// Coordinate hit-and-run: one coordinate after the other is drawn anew from its conditional distribution.
///
/// Along e_j the body is the chord [t₋, t₊] with t₋ = −1/max_k(a_kj/s_k), t₊ = −1/min_k(a_kj/s_k), where
/// s = offset + slope y > 0 are the slacks; a step changes them by t a_j, so that it costs O(K). Coordinates
/// take turns; every step by itself leaves the distribution as it is, so that any order does.
///
/// The density on the body is uniform (precision a = 0), or exp(−a ‖y‖²/2): then a level below the density of
/// the present point is drawn first, and the chord is cut to where the density exceeds it (slice sampling).
class CoordinateWalk {
 public:
  /// `body` must outlive the walk. Precondition: y is strictly inside.
  CoordinateWalk(const RoundedBody& body, Eigen::VectorXd y, Random random);

  /// Draws every coordinate once.
  void sweep(double precision = 0);
  /// Recomputes the slacks from y, and so takes away the rounding errors that steps have added up.
  void refresh();
  const Eigen::VectorXd& position() const { return y_; }

 private:
  const RoundedBody* body_;
  Eigen::VectorXd y_;
  Eigen::VectorXd slacks_;
  Random random_;
};

}  // namespace indet
