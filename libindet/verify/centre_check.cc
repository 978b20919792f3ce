#include "libindet/verify/centre_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/tolerances.h"
#include "libindet/verify/rebuilt_ellipsoid.h"

namespace indet {
namespace {

constexpr int kMostWidths = 500;  ///< each takes some solves

}  // namespace

void check_centre(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                  Comparisons& compare) {
  const Eigen::VectorXd centre =
      Eigen::Map<const Eigen::VectorXd>(ranges.centre.data(), ranges.centre.size()) / ranges.force_unit;
  const double scale = std::max(problem.internal_unit(), centre.lpNorm<Eigen::Infinity>());
  const double imbalance = problem.imbalance(centre) / scale;
  compare.require(imbalance <= tolerance::kDrawCentre, "centre: its forces do not balance ({})", imbalance);
  if (imbalance > tolerance::kDrawCentre) return;
  const auto ellipsoid = RebuiltEllipsoid::about(problem, centre, tolerance::kTightHalfPlane * scale);
  if (!ellipsoid) {
    compare.leave_unchecked("width of /ranges (the centre lies on a half-plane that is closed)");
    return;
  }
  // The search ends where x s = 1 holds to kCentring for each edge; twice that is left for rounding.
  const double allowed = 2 * tolerance::kCentring * std::sqrt(problem.half_planes());
  const double away = ellipsoid->decrement();
  compare.require(away <= allowed, "centre: the analytic centre is elsewhere ({})", away);
  const int step = (packing.contact_count() + kMostWidths - 1) / kMostWidths;
  for (int i = 0; i < packing.contact_count(); i += step) {
    for (const int k : {0, 1}) {
      const double width = ranges.width(i, k) / ranges.force_unit;
      compare.equal(width, ellipsoid->width(2 * i + k),
                    fmt::format("width of {} of contact {}", k == 0 ? "R" : "T", i), tolerance::kDrawCentre,
                    scale);
    }
  }
  if (step > 1) compare.leave_unchecked(fmt::format("width of /ranges, but for one in {} contacts", step));
}

}  // namespace indet
