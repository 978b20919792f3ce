#include "libindet/verify/affine_hull.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libindet/base/disjoint_sets.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/lu.h"
#include "libindet/dense/qr.h"

namespace indet {
namespace {

bool is_clear(double value) { return value <= tolerance::kHullRounding || value > tolerance::kHullClear; }

}  // namespace

std::optional<AffineHull> AffineHull::at(const RebuiltProblem& problem, const Eigen::VectorXd& interior) {
  if (!interior.allFinite()) return std::nullopt;
  const Eigen::Index half_planes = problem.half_planes();
  const Eigen::Index d = problem.kernel().cols();
  const double scale =
      interior.size() > 0 ? std::max(problem.internal_unit(), interior.lpNorm<Eigen::Infinity>()) : 1.0;
  Eigen::MatrixXd normals(half_planes, d);
  std::vector<Eigen::Index> tight;
  for (Eigen::Index h = 0; h < half_planes; ++h) {
    normals.row(h) = problem.normal_of(static_cast<int>(h)).transpose();
    const double slack = problem.slack(static_cast<int>(h), interior) / scale;
    if (!is_clear(slack)) return std::nullopt;
    // Where the kernel does not move a half-plane at all, what is left of its normal is rounding.
    const double length = normals.row(h).norm();
    if (!is_clear(length)) return std::nullopt;
    if (slack <= tolerance::kHullRounding && length > tolerance::kHullRounding) tight.push_back(h);
  }
  Eigen::MatrixXd within = Eigen::MatrixXd::Identity(d, d);
  if (!tight.empty() && d > 0) within = kernel_basis(normals(tight, Eigen::all), tolerance::kRebuiltRank);
  return AffineHull(problem.kernel() * within, normals * within);
}

bool AffineHull::freedom_is_clear() const {
  for (Eigen::Index k = 0; k < directions_.rows(); ++k) {
    if (!is_clear(freedom(static_cast<int>(k)))) return false;
  }
  return true;
}

std::optional<int> AffineHull::blocks() const {
  const Eigen::Index d = directions_.cols();
  if (d == 0) return 0;
  const std::vector<Eigen::Index> order = pivot_order(slopes_.transpose());
  Eigen::MatrixXd chosen(d, d);
  for (Eigen::Index j = 0; j < d; ++j) chosen.row(j) = slopes_.row(order[static_cast<std::size_t>(j)]);
  const Eigen::MatrixXd coefficients =
      Eigen::PartialPivLU<Eigen::MatrixXd>(chosen.transpose()).solve(slopes_.transpose());

  // Half-plane h is element h; the chosen ones stand for the coordinates.
  DisjointSets groups(slopes_.rows());
  std::vector<bool> moves(static_cast<std::size_t>(slopes_.rows()), false);
  for (Eigen::Index h = 0; h < slopes_.rows(); ++h) {
    for (Eigen::Index j = 0; j < d; ++j) {
      const double coefficient = std::abs(coefficients(j, h));
      if (!is_clear(coefficient)) return std::nullopt;
      if (coefficient <= tolerance::kHullRounding) continue;
      groups.join(h, order[static_cast<std::size_t>(j)]);
      moves[static_cast<std::size_t>(h)] = true;
    }
  }
  for (Eigen::Index h = 0; h + 1 < directions_.rows(); h += 2) {  // both edges of a contact
    if (moves[static_cast<std::size_t>(h)] && moves[static_cast<std::size_t>(h) + 1]) groups.join(h, h + 1);
  }
  int count = 0;
  for (std::size_t h = 0; h < moves.size(); ++h) count += moves[h] && groups.root(h) == h ? 1 : 0;
  return count;
}

}  // namespace indet
