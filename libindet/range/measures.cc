#include "libindet/range/measures.h"

#include <cmath>
#include <limits>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"

namespace indet {
namespace {

/// Where the simulated force lies between minimum (0) and maximum (1) [39].
double relative_position(double simulated, double minimum, double maximum, double force_unit) {
  const double width = maximum - minimum;
  if (!std::isfinite(width) || !(width > tolerance::kSliding * force_unit)) return ForceRanges::kNaN;
  return (simulated - minimum) / width;
}

/// From the contacts of a sample; NaN if a range was not found, or there is none.
SampleEstimate estimate_from_requested(const ForceRanges& ranges, const Eigen::VectorXd& measure) {
  std::vector<double> values;
  bool is_complete = ranges.status != PolytopeStatus::kEmpty && ranges.requested > 0;
  for (Eigen::Index i = 0; i < measure.size(); ++i) {
    if (ranges.outcome(i, kMinR) == Outcome::kNotRequested) continue;
    values.push_back(measure[i]);
    is_complete = is_complete && !std::isnan(measure[i]);
  }
  if (!is_complete) return {ForceRanges::kNaN, ForceRanges::kNaN, ForceRanges::kNaN, ForceRanges::kNaN};
  return estimate_from_sample(values, static_cast<int>(measure.size()));
}

}  // namespace

void compute_measures(const Packing& packing, ForceRanges& ranges) {
  const Eigen::Index count = packing.contact_count();
  const double unit = ranges.force_unit;
  for (auto* vector :
       {&ranges.delta_R, &ranges.delta_T, &ranges.d_R, &ranges.d_T, &ranges.R_star, &ranges.T_star}) {
    vector->setConstant(count, ForceRanges::kNaN);
  }
  ranges.norm = ranges.states.rowwise().norm();
  if (ranges.norm.size() > 0) {
    Eigen::Index largest = 0;
    ranges.norm.maxCoeff(&largest);
    ranges.largest_norm = static_cast<int>(largest);
  }
  const auto distance = [&](int first, int second) {
    if (first < 0 || second < 0) return ForceRanges::kNaN;
    return (ranges.states.row(first) - ranges.states.row(second)).norm() / unit;
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto value = ranges.value.row(i);
    const auto vertex = ranges.vertex.row(i);
    const Contact& contact = packing[ContactId(i)];
    ranges.delta_R[i] = (value[kMaxR] - value[kMinR]) / unit;
    ranges.delta_T[i] = (value[kMaxT] - value[kMinT]) / unit;
    ranges.d_R[i] = distance(vertex[kMaxR], vertex[kMinR]);
    ranges.d_T[i] = distance(vertex[kMaxT], vertex[kMinT]);
    ranges.R_star[i] = relative_position(contact.R, value[kMinR], value[kMaxR], unit);
    ranges.T_star[i] = relative_position(contact.T, value[kMinT], value[kMaxT], unit);
  }
  if (ranges.choice == ContactChoice::Kind::kSample) {
    ranges.sample_R = estimate_from_requested(ranges, ranges.delta_R);
    ranges.sample_T = estimate_from_requested(ranges, ranges.delta_T);
  }
  if (packing.has_simulated_forces()) {
    const CoulombCount coulomb = count_coulomb(packing, packing.simulated_forces(), tolerance::kSliding);
    ranges.sliding = coulomb.sliding;
    ranges.non_transmitting = coulomb.non_transmitting;
  }
}

}  // namespace indet
