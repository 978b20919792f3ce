#pragma once

#include <Eigen/Core>

#include "libindet/lp/feasible_set.h"

namespace indet::test {

/// [0, widths_1] × [0, widths_2] × …
inline FeasibleSet box(const Eigen::VectorXd& widths) {
  const Eigen::Index n = widths.size();
  FeasibleSet set;
  set.slope.resize(2 * n, n);
  set.slope << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
  set.offset.resize(2 * n);
  set.offset << Eigen::VectorXd::Zero(n), widths;
  return set;
}

/// {z ≥ 0, Σ z ≤ 1}: volume 1/n!; each coordinate has the distribution Beta(1, n).
inline FeasibleSet simplex(int n) {
  FeasibleSet set;
  set.slope.resize(n + 1, n);
  set.slope << Eigen::MatrixXd::Identity(n, n), -Eigen::RowVectorXd::Ones(n);
  set.offset = Eigen::VectorXd::Unit(n + 1, n);
  return set;
}

/// The cone {|z_i| ≤ z_0, i = 1 … n − 1} cut at z_0 ≤ 1: a pyramid of height 1 over a cube of width 2.
/// P(z_0 ≤ h) = hⁿ; given z_0 = h the others are uniform in [−h, h].
inline FeasibleSet cut_cone(int n) {
  FeasibleSet set;
  set.slope = Eigen::MatrixXd::Zero(2 * n - 1, n);
  set.offset = Eigen::VectorXd::Unit(2 * n - 1, 0);
  set.slope(0, 0) = -1;
  for (int i = 1; i < n; ++i) {
    set.slope(2 * i - 1, 0) = set.slope(2 * i, 0) = 1;
    set.slope(2 * i - 1, i) = 1;
    set.slope(2 * i, i) = -1;
  }
  return set;
}

/// {M z : z in the set}.
inline FeasibleSet mapped(const FeasibleSet& set, const Eigen::MatrixXd& inverse) {
  FeasibleSet result;
  result.slope = set.slope * inverse;
  result.offset = set.offset;
  return result;
}

}  // namespace indet::test
