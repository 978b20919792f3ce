#include "libindet/lp/purification.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

struct Stop {
  int inequality = -1;
  double distance = std::numeric_limits<double>::infinity();
};

/// The first inequality that the ray x + s·rate meets; among (nearly) equal distances the steepest, for
/// stability.
Stop first_stop(const Eigen::VectorXd& x, const Eigen::VectorXd& rate, const std::vector<bool>& active) {
  Stop stop;
  const double still = tolerance::kPurificationRate * std::max(1.0, rate.lpNorm<Eigen::Infinity>());
  for (Eigen::Index i = 0; i < rate.size(); ++i) {
    if (active[static_cast<std::size_t>(i)] || rate[i] >= -still) continue;
    const double distance = std::max(0.0, x[i]) / -rate[i];
    const bool nearer = distance < stop.distance * (1 - tolerance::kNearerStop);
    const bool steeper = distance <= stop.distance && rate[i] < rate[std::max(0, stop.inequality)];
    if (stop.inequality < 0 || nearer || steeper) stop = {static_cast<int>(i), distance};
  }
  return stop;
}

/// Orthonormal basis of the directions in `free` (orthonormal columns) that are orthogonal to `row`.
Eigen::MatrixXd without(const Eigen::MatrixXd& free, const Eigen::VectorXd& row) {
  Eigen::VectorXd reflector = free.transpose() * row;
  const double length = reflector.norm();
  reflector[0] += std::copysign(length, reflector[0]);
  reflector.normalize();
  Eigen::MatrixXd reflected = free;
  reflected.noalias() -= 2 * (free * reflector) * reflector.transpose();
  return reflected.rightCols(free.cols() - 1);
}

}  // namespace

Basis purify_to_vertex(const SlopeView& view, const Eigen::VectorXd& z, const Eigen::VectorXd& guide) {
  const int d = view.dim();
  Basis basis;
  std::vector<bool> active(static_cast<std::size_t>(view.inequalities()), false);
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(d, d);
  Eigen::VectorXd x = view.offset + view.slope * z;
  while (free.cols() > 0) {
    const Eigen::VectorXd projected = free.transpose() * guide;
    const bool guided = projected.norm() > tolerance::kPurificationRate * std::max(1.0, guide.norm());
    Eigen::VectorXd direction =
        guided ? Eigen::VectorXd(free * projected.normalized()) : Eigen::VectorXd(free.col(0));
    Eigen::VectorXd rate = view.slope * direction;
    Stop stop = first_stop(x, rate, active);
    if (stop.inequality < 0) {  // nothing in that way: the set is unbounded there; turn round
      rate = -rate;
      stop = first_stop(x, rate, active);
    }
    if (stop.inequality < 0) throw LibraryError("the feasible set contains a line");
    x += stop.distance * rate;
    x[stop.inequality] = 0;
    active[static_cast<std::size_t>(stop.inequality)] = true;
    basis.push_back(stop.inequality);
    free = without(free, view.slope.row(stop.inequality).transpose());
  }
  std::sort(basis.begin(), basis.end());
  return basis;
}

}  // namespace indet
