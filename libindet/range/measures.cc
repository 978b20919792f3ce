#include "libindet/range/measures.h"

#include <cmath>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/range/width_predictions.h"

namespace indet {
namespace {

/// Where the simulated force lies between minimum (0) and maximum (1) [39].
double relative_position(double simulated, double minimum, double maximum, double internal_unit) {
  const double width = maximum - minimum;
  if (!std::isfinite(width) || !(width > tolerance::kPointRange * internal_unit)) return kNaN;
  return (simulated - minimum) / width;
}

/// From the contacts that were drawn with unequal probabilities. `prediction`: of the measure, of all
/// contacts.
SampleEstimate estimate_from_draw(const ContactDraw& draw, const Eigen::VectorXd& measure,
                                  const Eigen::VectorXd& prediction) {
  const double total = draw.weight.cast<double>().sum();
  std::vector<DrawnValue> values;
  for (Eigen::Index i = 0; i < measure.size(); ++i) {
    if (draw.drawn[i] == 0) continue;
    if (std::isnan(measure[i])) return {};
    values.push_back({measure[i], draw.weight[i] / total, draw.drawn[i], prediction[i]});
  }
  return estimate_by_regression(values, static_cast<int>(measure.size()), prediction.mean());
}

/// From contacts that were equally likely.
SampleEstimate estimate_from_requested(const Table4<Outcome>& outcome, const Eigen::VectorXd& measure) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < measure.size(); ++i) {
    if (outcome(i, kMinR) == Outcome::kNotRequested) continue;
    if (std::isnan(measure[i])) return {};
    values.push_back(measure[i]);
  }
  if (values.empty()) return {};
  return estimate_from_sample(values, static_cast<int>(measure.size()));
}

}  // namespace

StateDistances state_distances(const Rows<double>& states, const Table4<std::int32_t>& vertex,
                               double force_unit) {
  const auto distance = [&](int first, int second) {
    if (first < 0 || second < 0) return kNaN;
    return (states.row(first) - states.row(second)).norm() / force_unit;
  };
  StateDistances distances{Eigen::VectorXd(vertex.rows()), Eigen::VectorXd(vertex.rows())};
  for (Eigen::Index i = 0; i < vertex.rows(); ++i) {
    distances.d_R[i] = distance(vertex(i, kMaxR), vertex(i, kMinR));
    distances.d_T[i] = distance(vertex(i, kMaxT), vertex(i, kMinT));
  }
  return distances;
}

void measure_states(const ExtremalStates& extremal, double force_unit, Measures& measures) {
  measures.norm = extremal.states.rowwise().norm();
  measures.largest_norm = -1;
  if (measures.norm.size() > 0) {
    Eigen::Index largest = 0;
    measures.norm.maxCoeff(&largest);
    measures.largest_norm = static_cast<int>(largest);
  }
  StateDistances distances = state_distances(extremal.states, extremal.vertex, force_unit);
  measures.d_R = std::move(distances.d_R);
  measures.d_T = std::move(distances.d_T);
}

Measures measure(const Packing& packing, const ProblemSummary& problem, const ContactRequest& request,
                 const ExtremalStates& extremal, const Certified& certified) {
  const Eigen::Index count = packing.contact_count();
  const double unit = problem.force_unit;
  const double internal_unit = packing.force_units().internal_in_scene();
  Measures measures;
  for (auto* vector : {&measures.delta_R, &measures.delta_T, &measures.R_star, &measures.T_star})
    vector->setConstant(count, kNaN);
  measure_states(extremal, unit, measures);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto value = certified.value.row(i);
    const Contact& contact = packing[ContactId(i)];
    measures.delta_R[i] = (value[kMaxR] - value[kMinR]) / unit;
    measures.delta_T[i] = (value[kMaxT] - value[kMinT]) / unit;
    measures.R_star[i] = relative_position(contact.R, value[kMinR], value[kMaxR], internal_unit);
    measures.T_star[i] = relative_position(contact.T, value[kMinT], value[kMaxT], internal_unit);
  }
  if (request.draws > 0) {
    const WidthPredictions of_R(packing, request, problem.dim, false);
    const WidthPredictions of_T(packing, request, problem.dim, true);
    measures.sample_R = estimate_from_draw(request, measures.delta_R, of_R.deltas() / unit);
    measures.sample_T = estimate_from_draw(request, measures.delta_T, of_T.deltas() / unit);
    if (request.draws >= kFewestForRegression) measures.estimator = DrawEstimator::kRegression;
  } else if (request.choice == ContactChoice::Kind::kSample) {
    measures.sample_R = estimate_from_requested(certified.outcome, measures.delta_R);
    measures.sample_T = estimate_from_requested(certified.outcome, measures.delta_T);
  }
  if (packing.has_simulated_forces()) {
    const CoulombCount coulomb = count_coulomb(packing, packing.simulated_forces(), tolerance::kSliding);
    measures.sliding = coulomb.sliding;
    measures.non_transmitting = coulomb.non_transmitting;
  }
  return measures;
}

}  // namespace indet
