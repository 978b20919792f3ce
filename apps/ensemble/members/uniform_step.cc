#include "apps/ensemble/members/uniform_step.h"

#include <vector>

#include "apps/bridge/uniform_record.h"
#include "apps/ensemble/members/write_vector.h"
#include "libindet/sampling/placement.h"

namespace indet {
namespace {

constexpr Eigen::Index kFewestStates = 32;

std::string outcome_without_sample(PolytopeStatus status) {
  switch (status) {
    case PolytopeStatus::kUnbounded:
      return "unbounded";
    case PolytopeStatus::kPoint:
      return "point";
    default:
      return "empty";
  }
}

void write_probabilities(Hdf5File& file, const std::string& path, const std::vector<TwoSampleTest>& tests,
                         double TwoSampleTest::*p, const char* long_name) {
  std::vector<double> values;
  for (const TwoSampleTest& test : tests) values.push_back(test.*p);
  file.write(path, values, {values.size()}, {"1", long_name});
}

void write_bins(Hdf5File& file, const std::string& path, const BinnedValues& bins, const char* long_name) {
  file.write(path, bins.counts, {bins.counts.size()}, {"1", long_name});
  file.set_attribute(path, "first", bins.first);
  file.set_attribute(path, "width", bins.width);
}

void write_forces(Hdf5File& file, const std::string& sampling, const SampledForces& forces, int states) {
  const std::string group = "/bias/" + sampling;
  file.make_group(group);
  file.set_attribute(group, "states", states);
  write_bins(file, group + "/R", forces.force,
             "how often R lies in [k w, (k+1) w) mg, k = first, first+1, ...");
  write_bins(file, group + "/standard_R", forces.standard,
             "the same of (R - mean)/deviation, both of the uniform distribution of the contact");
  write_bins(file, group + "/R_star", forces.place, "the same of the place of R in its range");
}

void write_bias(Hdf5File& file, const SamplingBias& bias, int uniform_states) {
  file.make_group("/bias");
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, double>>{{"r", bias.r},
                                                   {"r_error", bias.r_error},
                                                   {"ratio", bias.ratio},
                                                   {"ratio_error", bias.ratio_error},
                                                   {"center_shift", bias.center_shift},
                                                   {"center_shift_error", bias.center_shift_error},
                                                   {"center_noise", bias.center_noise}})
    file.set_attribute("/bias", name, value);
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, int>>{{"states", bias.states},
                                                {"tested", bias.tested},
                                                {"means", bias.means},
                                                {"distributions", bias.distributions},
                                                {"control_means", bias.control_means},
                                                {"control_distributions", bias.control_distributions}})
    file.set_attribute("/bias", name, value);
  write_vector(file, "/bias/mean_R", bias.mean, {"mg", "mean R of perturb-and-resolve"});
  write_vector(file, "/bias/deviation_R", bias.deviation, {"mg", "standard deviation of R, the same"});
  write_vector(file, "/bias/effective_R", bias.effective,
               {"1", "effective states for the mean of R, the same"});
  write_vector(file, "/bias/uniform_effective_R", bias.uniform_effective,
               {"1", "effective states for the mean of R of the uniform distribution"});
  const char* mean = "p-value of equal means of R";
  const char* distribution = "p-value of equal distributions of R";
  write_probabilities(file, "/bias/p_mean", bias.tests, &TwoSampleTest::p_mean, mean);
  write_probabilities(file, "/bias/p_distribution", bias.tests, &TwoSampleTest::p_distribution, distribution);
  write_probabilities(file, "/bias/control_p_mean", bias.control, &TwoSampleTest::p_mean, mean);
  write_probabilities(file, "/bias/control_p_distribution", bias.control, &TwoSampleTest::p_distribution,
                      distribution);
  write_forces(file, "uniform", bias.uniform, uniform_states);
  write_forces(file, "perturb", bias.chain, bias.states);
}

}  // namespace

UniformResult sample_uniformly(const Packing& packing, const ForceRanges& ranges, const WeightStates& chain,
                               const UniformOptions& options) {
  const ForcePolytope polytope = find_force_polytope(packing);
  if (polytope.status != PolytopeStatus::kBounded)
    return {.outcome = outcome_without_sample(polytope.status)};
  const ConvexBody body = make_body(polytope);
  const UniformSample sample = sample_uniformly(body, options);
  UniformResult result{.outcome = sample.converged ? "converged" : "limit"};
  result.record = SamplingRecord{.method = "uniform",
                                 .center = body.units.scene(sample.center).value(),
                                 .numbers = numbers_of(polytope, sample, options),
                                 .components = components_of(body, sample)};
  if (packing.has_simulated_forces()) {
    const Placement placement = place_state(packing, body, sample, packing.simulated_forces(), &ranges);
    result.record->numbers.merge(numbers_of(placement));
    result.record->components->percentile_R = placement.percentile_R;
  }
  if (chain.value().cols() >= kFewestStates) result.bias = compare_with_uniform(body, sample, chain, &ranges);
  return result;
}

void write_uniform_part(Hdf5File& file, const UniformResult& result) {
  if (result.record) {
    write_sampling_part(file, *result.record, "/uniform");
  } else {
    file.make_group("/uniform");
  }
  file.set_attribute("/uniform", "outcome", result.outcome);
  if (result.bias) write_bias(file, *result.bias, static_cast<int>(result.record->numbers.at("samples")));
}

}  // namespace indet
