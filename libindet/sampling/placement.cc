#include "libindet/sampling/placement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"

namespace indet {
namespace {

/// The numbers that are compared, in the internal unit.
struct Values {
  double distance = 0, norm = 0, normal_force = 0, mobilisation = 0, R_star = kNaN;
};

double mean_mobilisation(const Packing& packing, const Eigen::VectorXd& state) {
  double sum = 0;
  int count = 0;
  for (int k = 0; k < packing.contact_count(); ++k) {
    const double limit = packing[ContactId(k)].mu * state[2 * k];
    if (!(limit > tolerance::kCoulombLimit)) continue;
    sum += std::abs(state[2 * k + 1]) / limit;
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

double mean_R_star(const ForceRanges& ranges, const ForceUnits& units, const Eigen::VectorXd& state) {
  const double unit = units.internal_in_weights();
  double sum = 0;
  int count = 0;
  for (Eigen::Index k = 0; k < ranges.delta_R.size(); ++k) {
    if (!(ranges.delta_R[k] > tolerance::kPointRange * unit) || std::isinf(ranges.delta_R[k])) continue;
    sum += (unit * state[2 * k] - ranges.value(k, kMinR) / ranges.force_unit) / ranges.delta_R[k];
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

Values values_of(const Packing& packing, const ForceUnits& units, const Eigen::VectorXd& center,
                 const Eigen::VectorXd& state, const ForceRanges* ranges) {
  Values v;
  v.distance = (state - center).norm();
  v.norm = state.norm();
  for (Eigen::Index k = 0; k < state.size(); k += 2) v.normal_force += state[k];
  v.mobilisation = mean_mobilisation(packing, state);
  if (ranges != nullptr) v.R_star = mean_R_star(*ranges, units, state);
  return v;
}

double percentile(const std::vector<Values>& samples, double Values::*member, double value) {
  if (std::isnan(value)) return kNaN;
  const auto below =
      std::count_if(samples.begin(), samples.end(), [&](const Values& v) { return v.*member < value; });
  return 100.0 * static_cast<double>(below) / static_cast<double>(samples.size());
}

}  // namespace

Placement place_state(const Packing& packing, const ConvexBody& body, const UniformSample& sample,
                      const SceneForces& state, const ForceRanges* ranges) {
  const ForceUnits& units = body.units;
  const Eigen::VectorXd F = units.internal(state).value();
  const Eigen::VectorXd& center = sample.center.value();
  const Values own = values_of(packing, units, center, F, ranges);
  Placement place;
  place.most_sliding = 0;
  place.sliding = count_coulomb(packing, state, tolerance::kSliding).sliding;
  double below = 0;  // of the samples, those with fewer sliding contacts, and half of those with as many
  std::vector<Values> samples;
  samples.reserve(static_cast<std::size_t>(sample.count()));
  for (Eigen::Index i = 0; i < sample.z.cols(); ++i) {
    const InternalForces drawn(body.states(sample.z.col(i)).value());
    samples.push_back(values_of(packing, units, center, drawn.value(), ranges));
    const int sliding = count_coulomb(packing, units.scene(drawn), tolerance::kSliding).sliding;
    place.most_sliding = std::max(place.most_sliding, sliding);
    below += sliding < place.sliding ? 1 : sliding == place.sliding ? 0.5 : 0;
  }
  place.sliding_percentile = 100 * below / static_cast<double>(samples.size());
  place.distance = units.weights(InternalForce(own.distance)).value();
  place.distance_percentile = percentile(samples, &Values::distance, own.distance);
  place.norm_percentile = percentile(samples, &Values::norm, own.norm);
  place.normal_force_percentile = percentile(samples, &Values::normal_force, own.normal_force);
  place.mobilisation_percentile = percentile(samples, &Values::mobilisation, own.mobilisation);
  place.mean_R_star = own.R_star;
  place.R_star_percentile = percentile(samples, &Values::R_star, own.R_star);

  place.percentile_R = Eigen::VectorXd::Constant(packing.contact_count(), kNaN);
  const double constant =
      tolerance::kConstantForce * packing.internal_force_unit() / units.internal_in_scene();
  int inside = 0;
  int counted = 0;
  for (int k = 0; k < body.frame.rows(); k += 2) {
    if (!(sample.deviation.value()[k] > constant)) continue;
    Eigen::VectorXd values = component_of(body, sample, k).value();
    std::sort(values.begin(), values.end());
    const std::span<const double> sorted(values.data(), static_cast<std::size_t>(values.size()));
    const auto smaller = std::lower_bound(sorted.begin(), sorted.end(), F[k]) - sorted.begin();
    place.percentile_R[k / 2] = 100 * static_cast<double>(smaller) / static_cast<double>(sorted.size());
    inside += sorted_quantile(sorted, 0.05) <= F[k] && F[k] <= sorted_quantile(sorted, 0.95) ? 1 : 0;
    ++counted;
  }
  place.central_fraction_R = counted > 0 ? static_cast<double>(inside) / counted : kNaN;
  return place;
}

}  // namespace indet
