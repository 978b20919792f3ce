#include "libindet/range/certify.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"

namespace indet {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void certify(const Packing& packing, ForceRanges& ranges) {
  const double unit = ranges.force_unit;
  const double least = packing.internal_force_unit() / unit;
  Eigen::VectorXd residual(ranges.states.rows());
  Eigen::VectorXd scale(ranges.states.rows());
  ranges.residual = 0;
  for (Eigen::Index k = 0; k < ranges.states.rows(); ++k) {
    const SceneForces forces(ranges.states.row(k).transpose());
    const double balance =
        packing.disk_count() > 0 ? equilibrium_residual(packing, forces).cwiseAbs().maxCoeff() : 0;
    scale[k] =
        std::max(least, forces.value().size() > 0 ? forces.value().lpNorm<Eigen::Infinity>() / unit : 0.0);
    residual[k] = std::max(balance, count_coulomb(packing, forces, 0).worst_violation) / scale[k];
    ranges.residual = std::max(ranges.residual, balance);
  }
  ranges.worst_primal_residual = 0;
  ranges.worst_dual_residual = 0;
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const bool is_left_out =
          ranges.outcome(i, column) == Outcome::kNotRequested && ranges.status != PolytopeStatus::kEmpty;
      if (is_left_out) continue;
      ++ranges.objectives;
      const int vertex = ranges.vertex(i, column);
      Outcome& outcome = ranges.outcome(i, column);
      if (vertex >= 0) {
        const double primal = residual[vertex];
        const double dual = ranges.dual_residual(i, column);
        const double value = ranges.states(vertex, 2 * i + (column >= kMinT ? 1 : 0));
        ranges.value(i, column) = value;
        if (ranges.doubtful) {  // the enclosure rests on decisions that are in doubt
          ranges.lower(i, column) = -kInfinity;
          ranges.upper(i, column) = kInfinity;
        }
        ranges.primal_residual(i, column) = primal;
        if (primal > tolerance::kPrimalResidual || dual > tolerance::kDualResidual)
          outcome = Outcome::kImprecise;
      } else if (std::isinf(ranges.value(i, column))) {
        ranges.lower(i, column) = ranges.upper(i, column) = ranges.value(i, column);
        if (outcome == Outcome::kImprecise || ranges.doubtful)  // it may be finite after all
          (ranges.value(i, column) > 0 ? ranges.lower : ranges.upper)(i, column) *= -1;
      }
      const bool has_value = outcome != Outcome::kFailed && outcome != Outcome::kNotRequested;
      if (has_value && ranges.doubtful) outcome = Outcome::kImprecise;
      if (has_value) {
        ranges.worst_primal_residual =
            std::max(ranges.worst_primal_residual, ranges.primal_residual(i, column));
        ranges.worst_dual_residual = std::max(ranges.worst_dual_residual, ranges.dual_residual(i, column));
      }
      ranges.certified += outcome == Outcome::kOptimal || outcome == Outcome::kUnbounded ? 1 : 0;
      ranges.unbounded += outcome == Outcome::kUnbounded ? 1 : 0;
      ranges.imprecise += outcome == Outcome::kImprecise ? 1 : 0;
      ranges.failed += outcome == Outcome::kFailed ? 1 : 0;
    }
  }
}

}  // namespace indet
