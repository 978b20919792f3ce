#include "libindet/verify/centre_check.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "libindet/base/tolerances.h"

namespace indet {

void check_centre(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  Comparisons& compare) {
  const Eigen::VectorXd centre =
      Eigen::Map<const Eigen::VectorXd>(ranges.centre.data(), ranges.centre.size()) / ranges.force_unit;
  const double scale = std::max(problem.internal_unit(), centre.lpNorm<Eigen::Infinity>());
  const double imbalance = problem.imbalance(centre) / scale;
  compare.require(imbalance <= tolerance::kDrawCentre, "centre: its forces do not balance ({})", imbalance);
  if (imbalance > tolerance::kDrawCentre) return;
  const int d = problem.nullity();
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(d);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(d, d);
  for (int h = 0; h < problem.half_planes(); ++h) {
    // Without friction both half-planes of a contact are R ≥ 0.
    const bool is_second = h < 2 * packing.contact_count() && h % 2 == 1;
    if (is_second && packing[ContactId(h / 2)].mu == 0) continue;
    const double slack = problem.slack(h, centre);
    if (slack <= tolerance::kTightHalfPlane * scale) {
      compare.leave_unchecked("width of /ranges (the centre lies on a half-plane that is closed)");
      return;
    }
    const Eigen::VectorXd normal = problem.normal_of(h) / slack;
    slope += normal;
    hessian.selfadjointView<Eigen::Lower>().rankUpdate(normal);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(hessian.selfadjointView<Eigen::Lower>());
  // Newton's decrement: the distance to the centre, over the ellipsoid.
  const double away = factor.matrixL().solve(slope).norm();
  compare.require(away <= tolerance::kDrawCentre, "centre: the analytic centre is elsewhere ({})", away);
  const Eigen::MatrixXd reach = factor.matrixL().solve(problem.kernel().transpose());
  for (Eigen::Index k = 0; k < reach.cols(); ++k) {
    const double width = ranges.width(k / 2, k % 2) / ranges.force_unit;
    compare.equal(width, reach.col(k).norm(),
                  fmt::format("width of {} of contact {}", k % 2 == 0 ? "R" : "T", k / 2),
                  tolerance::kDrawCentre, scale);
  }
}

}  // namespace indet
