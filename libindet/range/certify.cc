#include "libindet/range/certify.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/range/barrier_ranges.h"

namespace indet {
namespace {

struct StateResiduals {
  Eigen::VectorXd primal;  ///< Of each state, over the largest of its forces.
  double balance = 0;      ///< The largest ‖cF + w‖∞.
};

StateResiduals residuals_of(const Packing& packing, double unit, const Rows<double>& states) {
  const double least = packing.internal_force_unit() / unit;
  const std::vector<ForceBound> bounds = force_bounds(packing);
  StateResiduals result;
  result.primal.resize(states.rows());
  for (Eigen::Index k = 0; k < states.rows(); ++k) {
    const SceneForces forces(states.row(k).transpose());
    const double balance = largest_imbalance(packing, forces);
    const double scale =
        std::max(least, forces.value().size() > 0 ? forces.value().lpNorm<Eigen::Infinity>() / unit : 0.0);
    result.primal[k] = std::max({balance, count_coulomb(packing, forces, 0).worst_violation,
                                 worst_bound_violation(bounds, forces) / unit}) /
                       scale;
    result.balance = std::max(result.balance, balance);
  }
  return result;
}

/// Value, enclosure and outcome of one objective.
void certify_objective(const Extrema& extrema, const StateResiduals& residuals, double weight, Eigen::Index i,
                       int column, Certified& result) {
  const int vertex = extrema.vertex(i, column);
  Outcome& outcome = result.outcome(i, column);
  double& value = result.value(i, column);
  double& lower = result.lower(i, column);
  double& upper = result.upper(i, column);
  if (vertex >= 0) {
    value = extrema.states(vertex, 2 * i + (column >= kMinT ? 1 : 0));
    if (result.doubtful) {  // the enclosure rests on decisions that are in doubt
      lower = -kInfinity;
      upper = kInfinity;
    }
    result.primal_residual(i, column) = residuals.primal[vertex];
    const bool is_precise = result.primal_residual(i, column) <= tolerance::kPrimalResidual &&
                            result.dual_residual(i, column) <= tolerance::kDualResidual;
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
  const bool has_value = outcome != Outcome::kFailed && outcome != Outcome::kNotRequested;
  if (has_value && result.doubtful) outcome = Outcome::kImprecise;
}

}  // namespace

Certified certify(const Packing& packing, const ProblemSummary& problem, const Extrema& extrema,
                  const Enclosures& enclosures) {
  const StateResiduals residuals = residuals_of(packing, problem.force_unit, extrema.states);
  Certified result;
  result.doubtful = !enclosures.proven;
  result.value.setConstant(extrema.claim.rows(), 4, std::numeric_limits<double>::quiet_NaN());
  result.lower = enclosures.lower;
  result.upper = enclosures.upper;
  result.sensitivity = enclosures.sensitivity;
  result.outcome = extrema.claim;
  result.primal_residual = extrema.ray_residual;
  result.dual_residual = extrema.dual_residual;
  result.residual = residuals.balance;
  result.worst_primal_residual = result.worst_dual_residual = 0;
  for (Eigen::Index i = 0; i < result.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const bool is_left_out =
          result.outcome(i, column) == Outcome::kNotRequested && problem.status != PolytopeStatus::kEmpty;
      if (is_left_out) continue;
      ++result.objectives;
      certify_objective(extrema, residuals, problem.force_unit, i, column, result);
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
