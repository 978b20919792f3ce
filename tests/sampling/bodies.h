#pragma once

#include <Eigen/Core>

#include "libindet/lp/feasible_set.h"

namespace indet::test {

/// [0, widths_1] × [0, widths_2] × …
inline SlopeView box(const Eigen::VectorXd& widths) {
  const Eigen::Index n = widths.size();
  SlopeView view;
  view.slope.resize(2 * n, n);
  view.slope << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
  view.offset.resize(2 * n);
  view.offset << Eigen::VectorXd::Zero(n), widths;
  return view;
}

/// {z ≥ 0, Σ z ≤ 1}: volume 1/n!; each coordinate has the distribution Beta(1, n).
inline SlopeView simplex(int n) {
  SlopeView view;
  view.slope.resize(n + 1, n);
  view.slope << Eigen::MatrixXd::Identity(n, n), -Eigen::RowVectorXd::Ones(n);
  view.offset = Eigen::VectorXd::Unit(n + 1, n);
  return view;
}

/// The cone {|z_i| ≤ z_0, i = 1 … n − 1} cut at z_0 ≤ 1: a pyramid of height 1 over a cube of width 2.
/// P(z_0 ≤ h) = hⁿ; given z_0 = h the others are uniform in [−h, h].
inline SlopeView cut_cone(int n) {
  SlopeView view;
  view.slope = Eigen::MatrixXd::Zero(2 * n - 1, n);
  view.offset = Eigen::VectorXd::Unit(2 * n - 1, 0);
  view.slope(0, 0) = -1;
  for (int i = 1; i < n; ++i) {
    view.slope(2 * i - 1, 0) = view.slope(2 * i, 0) = 1;
    view.slope(2 * i - 1, i) = 1;
    view.slope(2 * i, i) = -1;
  }
  return view;
}

/// {M z : z in the set}.
inline SlopeView mapped(const SlopeView& view, const Eigen::MatrixXd& inverse) {
  SlopeView result;
  result.slope = view.slope * inverse;
  result.offset = view.offset;
  return result;
}

}  // namespace indet::test
