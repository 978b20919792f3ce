#pragma once

#include <Eigen/Core>

#include "libindet/range/outcome.h"

namespace indet {

/// The smallest distance of two states of which one has the largest and one the smallest value of a force:
///
///   dR_min = min ‖F − F'‖/mg   over F, F' in the polytope with R_α(F) = R_α,max, R_α(F') = R_α,min
///
/// dT_min alike. It is how much the forces of all contacts have to change at least when that force goes
/// through its range. Unlike dR, dT [24] it does not depend on which of several extremal states are taken,
/// and is at most as large.
///
/// M contacts, columns R, T; no rows where it was not asked for. In mg; NaN where it is not known.
struct SmallestDistances {
  using Table = Eigen::Array<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
  /// Of two states that are proven to be there. As far as they miss the extremes (shortage) this can be less
  /// than `lower`.
  Eigen::VectorXd d_R, d_T;
  Table lower;     ///< No two states of extremal value are nearer: proven.
  Table shortage;  ///< By how much, together, the values of the two states miss the extremes at most.
  /// kEnclosed: shortage and |d − lower| are within tolerance (tolerance::kFaceShortage, kDistanceGap).
  /// kImprecise: they are not. kFailed: there is no centre, or the bounds leave a factor
  /// of two. kNotRequested.
  Eigen::Array<Outcome, Eigen::Dynamic, 2, Eigen::RowMajor> outcome;

  Eigen::VectorXd& of(int component) { return component == 0 ? d_R : d_T; }
  const Eigen::VectorXd& of(int component) const { return component == 0 ? d_R : d_T; }
  Eigen::Index count(Outcome what) const { return (outcome == what).count(); }
};

}  // namespace indet
