#include "libindet/sampling/bias.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

std::span<const double> span_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

double variance_of(const Eigen::VectorXd& values) { return (values.array() - values.mean()).square().mean(); }

/// A quantity over the states of one sample.
struct Quantity {
  Eigen::VectorXd values;
  double effective = 0;

  CorrelatedSample sample() const { return {span_of(values), effective}; }
  /// Values that are all the same have no effective size, and a mean that may be rounded away from them.
  double variance_of_mean() const { return std::isnan(effective) ? 0 : variance_of(values) / effective; }
};

class Comparison {
 public:
  Comparison(const ConvexBody& body, const UniformSample& sample, const WeightStates& chain)
      : body_(body),
        sample_(sample),
        center_(body.units.weights(sample.center).value()),
        deviation_(body.units.weights(sample.deviation).value()),
        chain_(chain.value()),
        uniform_assessor_(sample.chains, sample.length),
        half_assessor_(sample.chains / 2, sample.length),
        chain_assessor_(1, static_cast<int>(chain_.cols())) {}

  SamplingBias run(const ForceRanges* ranges) {
    const Eigen::Index contacts = body_.frame.rows() / 2;
    bias_.states = static_cast<int>(chain_.cols());
    bias_.mean = bias_.deviation = Eigen::VectorXd::Constant(contacts, kNaN);
    bias_.effective = bias_.uniform_effective = bias_.mean;
    bias_.tests.resize(static_cast<std::size_t>(contacts));
    bias_.control.resize(static_cast<std::size_t>(contacts));
    for (Eigen::Index k = 0; k < body_.frame.rows(); ++k) {
      const Quantity uniform =
          of_uniform(body_.units.weights(component_of(body_, sample_, static_cast<int>(k))).value());
      const Quantity chain = of_chain(chain_.row(k).transpose());
      noise_ += uniform.variance_of_mean() + chain.variance_of_mean();
      if (k % 2 == 0) compare(k / 2, uniform, chain, ranges);
    }
    compare_radii();
    compare_centres();
    count();
    return std::move(bias_);
  }

 private:
  Quantity of_uniform(Eigen::VectorXd values) const {
    const double effective = uniform_assessor_.effective_size(span_of(values));
    return {std::move(values), effective};
  }
  Quantity of_chain(Eigen::VectorXd values) const {
    const double effective = chain_assessor_.effective_size(span_of(values));
    return {std::move(values), effective};
  }

  /// False where R is determined.
  bool varies(Eigen::Index contact) const {
    return sample_.deviation.value()[2 * contact] > tolerance::kConstantForce;
  }

  void compare(Eigen::Index contact, const Quantity& uniform, const Quantity& chain,
               const ForceRanges* ranges) {
    const auto i = static_cast<std::size_t>(contact);
    bias_.mean[contact] = chain.values.mean();
    bias_.deviation[contact] = std::sqrt(variance_of(chain.values));
    bin(contact, uniform.values, ranges, bias_.uniform);
    bin(contact, chain.values, ranges, bias_.chain);
    if (!varies(contact)) return;
    bias_.effective[contact] = chain.effective;
    bias_.uniform_effective[contact] = uniform.effective;
    if (chain.effective >= SamplingBias::kFewest)
      bias_.tests[i] = compare_samples(chain.sample(), uniform.sample());
    const Eigen::Index half = static_cast<Eigen::Index>(sample_.chains / 2) * sample_.length;
    const auto part = [&](Eigen::Index first) {
      const std::span<const double> values =
          span_of(uniform.values).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(half));
      return CorrelatedSample{values, half_assessor_.effective_size(values)};
    };
    bias_.control[i] = compare_samples(part(0), part(half));
  }

  void bin(Eigen::Index contact, const Eigen::VectorXd& values, const ForceRanges* ranges,
           SampledForces& forces) const {
    const double mean = center_[2 * contact];
    const double deviation = deviation_[2 * contact];
    const double range = ranges == nullptr ? kNaN : ranges->delta_R[contact];
    const double low = ranges == nullptr ? kNaN : ranges->value(contact, kMinR) / ranges->force_unit;
    for (const double R : values) {
      forces.force.add(std::max(R, 0.0));  // rounding around 0
      if (varies(contact)) forces.standard.add((R - mean) / deviation);
      if (range > tolerance::kPointRange * body_.units.internal_in_weights() && std::isfinite(range))
        forces.place.add(std::clamp((R - low) / range, 0.0, 1 - tolerance::kLastBin));
    }
  }

  void compare_radii() {
    const Eigen::VectorXd center = chain_.rowwise().mean();
    const Quantity squares = of_chain((chain_.colwise() - center).colwise().squaredNorm().transpose());
    bias_.r = std::sqrt(squares.values.mean());
    bias_.r_error = bias_.r > 0 ? std::sqrt(squares.variance_of_mean()) / (2 * bias_.r) : 0;
    const double r = body_.units.weights(sample_.r).value();
    const double r_error = body_.units.weights(sample_.r_error).value();
    bias_.ratio = bias_.r / r;
    bias_.ratio_error = std::hypot(bias_.r_error, bias_.ratio * r_error) / r;
  }

  void compare_centres() {
    const Eigen::VectorXd difference = chain_.rowwise().mean() - center_;
    const double distance = difference.norm();
    bias_.center_noise = std::sqrt(noise_);
    bias_.center_shift = std::sqrt(std::max(0.0, distance * distance - noise_));
    bias_.center_shift_error = 0;
    if (!(distance > 0)) return;
    const Eigen::VectorXd direction = difference / distance;
    const Eigen::VectorXd along = body_.frame.transpose() * direction;
    const Quantity uniform = of_uniform(body_.units.internal_in_weights() * (sample_.z.transpose() * along));
    const Quantity chain = of_chain(chain_.transpose() * direction);
    bias_.center_shift_error = std::sqrt(uniform.variance_of_mean() + chain.variance_of_mean());
  }

  void count() {
    const auto discoveries = [](const std::vector<TwoSampleTest>& tests, double TwoSampleTest::*p) {
      std::vector<double> values;
      for (const TwoSampleTest& test : tests) values.push_back(test.*p);
      return count_discoveries(values, SamplingBias::kRate);
    };
    bias_.tested = static_cast<int>(std::count_if(bias_.tests.begin(), bias_.tests.end(),
                                                  [](const auto& t) { return !std::isnan(t.p_mean); }));
    bias_.means = discoveries(bias_.tests, &TwoSampleTest::p_mean);
    bias_.distributions = discoveries(bias_.tests, &TwoSampleTest::p_distribution);
    bias_.control_means = discoveries(bias_.control, &TwoSampleTest::p_mean);
    bias_.control_distributions = discoveries(bias_.control, &TwoSampleTest::p_distribution);
  }

  const ConvexBody& body_;
  const UniformSample& sample_;
  const Eigen::VectorXd center_, deviation_;  ///< of the uniform sample, mg
  const Eigen::MatrixXd& chain_;              ///< mg
  ChainAssessor uniform_assessor_, half_assessor_, chain_assessor_;
  double noise_ = 0;
  SamplingBias bias_;
};

}  // namespace

void BinnedValues::add(double value) {
  const int bin = static_cast<int>(std::floor(value / width));
  if (counts.empty()) first = bin;
  if (bin < first) {
    counts.insert(counts.begin(), static_cast<std::size_t>(first - bin), 0);
    first = bin;
  }
  const auto place = static_cast<std::size_t>(bin - first);
  if (place >= counts.size()) counts.resize(place + 1, 0);
  ++counts[place];
}

SamplingBias compare_with_uniform(const ConvexBody& body, const UniformSample& sample,
                                  const WeightStates& chain, const ForceRanges* ranges) {
  return Comparison(body, sample, chain).run(ranges);
}

}  // namespace indet
