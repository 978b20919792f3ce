#include "libindet/range/certify.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/range/barrier_ranges.h"
#include "libindet/range/promise.h"

namespace indet {
namespace {

/// Value, enclosure and outcome of one objective.
/// `weight`: 1 mg, `load`: of the contact, both in the scene's units.
void certify_objective(const Extrema& extrema, double weight, double load, Eigen::Index i, int column,
                       Certified& result) {
  Outcome& outcome = result.outcome(i, column);
  double& value = result.value(i, column);
  double& lower = result.lower(i, column);
  double& upper = result.upper(i, column);
  if (!std::isnan(extrema.value(i, column))) {
    value = extrema.value(i, column);
    if (result.doubtful) {  // the enclosure rests on decisions that are in doubt
      lower = -kInfinity;
      upper = kInfinity;
    }
    result.primal_residual(i, column) = extrema.primal_residual(i, column);
    const bool is_precise = result.primal_residual(i, column) <= tolerance::kPrimalResidual &&
                            result.dual_residual(i, column) <= tolerance::kDualResidual &&
                            upper - lower <= promised_width(value, load);
    if (!is_precise) outcome = Outcome::kImprecise;
  } else if (outcome == Outcome::kEnclosed) {
    const EnclosedValue enclosed = enclosed_value(lower, upper, extrema.gap, weight);
    value = enclosed.value;
    outcome = enclosed.outcome;
  } else if (outcome == Outcome::kUnbounded || outcome == Outcome::kImprecise) {
    const bool is_maximum = column == kMaxR || column == kMaxT;
    lower = upper = value = is_maximum ? kInfinity : -kInfinity;
    if (outcome == Outcome::kImprecise || result.doubtful)  // it may be finite after all
      (is_maximum ? lower : upper) *= -1;
  }
  const bool has_value = outcome != Outcome::kFailed && !is_left_out(outcome);
  if (has_value && result.doubtful) outcome = Outcome::kImprecise;
}

}  // namespace

Certified certify(const Packing& packing, const ProblemSummary& problem, const Extrema& extrema,
                  const Enclosures& enclosures) {
  Certified result;
  result.doubtful = !enclosures.proven;
  result.value.setConstant(extrema.claim.rows(), 4, std::numeric_limits<double>::quiet_NaN());
  result.lower = enclosures.lower;
  result.upper = enclosures.upper;
  result.sensitivity = enclosures.sensitivity;
  result.outcome = extrema.claim;
  result.primal_residual = extrema.ray_residual;
  result.dual_residual = extrema.dual_residual;
  result.residual = extrema.imbalance;
  result.worst_primal_residual = result.worst_dual_residual = 0;
  const Eigen::VectorXd loads = loads_at_contacts(packing);
  for (Eigen::Index i = 0; i < result.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      if (problem.status != PolytopeStatus::kEmpty && is_left_out(result.outcome(i, column))) continue;
      ++result.objectives;
      certify_objective(extrema, problem.force_unit, loads[i], i, column, result);
      const Outcome outcome = result.outcome(i, column);
      if (outcome != Outcome::kFailed && outcome != Outcome::kNotRequested) {
        // An interval has neither.
        result.worst_primal_residual =
            std::fmax(result.worst_primal_residual, result.primal_residual(i, column));
        result.worst_dual_residual = std::fmax(result.worst_dual_residual, result.dual_residual(i, column));
      }
      result.certified += is_certified(outcome) ? 1 : 0;
      result.enclosed += outcome == Outcome::kEnclosed ? 1 : 0;
      result.unbounded += outcome == Outcome::kUnbounded ? 1 : 0;
      result.imprecise += outcome == Outcome::kImprecise ? 1 : 0;
      result.failed += outcome == Outcome::kFailed ? 1 : 0;
    }
  }
  return result;
}

}  // namespace indet
