#include "apps/bridge/uniform_record.h"

#include <algorithm>
#include <cmath>

namespace indet {

std::map<std::string, double> numbers_of_point(const UniformSample& sample, const ForceUnits& units,
                                               const UniformOptions& options) {
  return {{"dim", 0},
          {"blocks", 0},
          {"seed", static_cast<double>(options.seed)},
          {"r", units.weights(sample.r).value()},
          {"r_error", units.weights(sample.r_error).value()},
          {"spread", units.weights(sample.spread).value()},
          {"mean_norm", units.weights(sample.mean_norm).value()},
          {"norm_deviation", units.weights(sample.norm_deviation).value()},
          {"converged", sample.converged ? 1 : 0}};
}

std::map<std::string, double> numbers_of(const ForcePolytope& polytope, const UniformSample& sample,
                                         const UniformOptions& options) {
  const ForceUnits& units = polytope.problem.units;
  std::map<std::string, double> numbers = numbers_of_point(sample, units, options);
  numbers["dim"] = polytope.dim;
  numbers["blocks"] = static_cast<double>(polytope.blocks.size());
  numbers.insert({{"requested", options.effective},
                  {"chains", sample.chains},
                  {"samples", sample.count()},
                  {"interval", static_cast<double>(sample.interval)},
                  {"sweeps", static_cast<double>(sample.sweeps)},
                  {"steps", static_cast<double>(sample.steps)},
                  {"warm_up_phases", sample.rounding.phases},
                  {"rhat", sample.rhat},
                  {"ess", std::min(sample.bulk, sample.tail)},
                  {"bulk_ess", sample.bulk},
                  {"tail_ess", sample.tail},
                  {"slowest", sample.slowest},
                  {"norm_rhat", sample.norm.rhat},
                  {"norm_bulk_ess", sample.norm.bulk},
                  {"norm_tail_ess", sample.norm.tail},
                  {"worst_slack", units.weights(InternalForce(sample.worst_slack)).value()},
                  {"inscribed_radius", units.weights(InternalForce(sample.ball.radius)).value()}});
  return numbers;
}

std::map<std::string, double> numbers_of(const Placement& placement) {
  std::map<std::string, double> numbers = {
      {"start_distance", placement.distance},
      {"start_distance_percentile", placement.distance_percentile},
      {"start_norm_percentile", placement.norm_percentile},
      {"start_normal_force_percentile", placement.normal_force_percentile},
      {"start_mobilisation_percentile", placement.mobilisation_percentile},
      {"start_central_fraction_R", placement.central_fraction_R},
      {"start_sliding", placement.sliding},
      {"start_sliding_percentile", placement.sliding_percentile},
      {"most_sliding", placement.most_sliding}};
  if (!std::isnan(placement.mean_R_star)) {
    numbers["start_mean_R_star"] = placement.mean_R_star;
    numbers["start_R_star_percentile"] = placement.R_star_percentile;
  }
  return numbers;
}

ComponentRecord components_of(const ConvexBody& body, const UniformSample& sample) {
  const Eigen::Index count = body.frame.rows();
  ComponentRecord record;
  record.deviation = body.units.scene(sample.deviation).value();
  record.quantile_levels.resize(5);
  record.quantile_levels << 0.05, 0.25, 0.5, 0.75, 0.95;
  record.quantiles.resize(count, 5);
  record.rhat.resize(count);
  record.bulk.resize(count);
  record.tail.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Convergence& c = sample.components[static_cast<std::size_t>(k)];
    record.rhat[k] = c.rhat;
    record.bulk[k] = c.bulk;
    record.tail[k] = c.tail;
    Eigen::VectorXd values = body.units.scene(component_of(body, sample, static_cast<int>(k))).value();
    std::sort(values.begin(), values.end());
    for (int q = 0; q < 5; ++q) {
      record.quantiles(k, q) = sorted_quantile({values.data(), static_cast<std::size_t>(values.size())},
                                               record.quantile_levels[q]);
    }
  }
  return record;
}

InternalStates some_states(const ConvexBody& body, const UniformSample& sample, int count) {
  Eigen::MatrixXd z(body.dim(), count);
  for (int i = 0; i < count; ++i)
    z.col(i) = sample.z.col(static_cast<Eigen::Index>(i) * sample.count() / count);
  return body.states(z);
}

UniformSample sample_of_point(const ForcePolytope& polytope) {
  UniformSample sample;
  sample.converged = true;
  sample.center = polytope.problem.state(polytope.lightest);
  sample.deviation = InternalForces(Eigen::VectorXd::Zero(sample.center.value().size()));
  sample.r = sample.r_error = sample.spread = sample.norm_deviation = InternalForce(0);
  sample.mean_norm = InternalForce(sample.center.value().norm());
  return sample;
}

}  // namespace indet
