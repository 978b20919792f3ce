#include "libindet/statistics/bootstrap.h"

#include <cmath>
#include <limits>
#include <vector>

#include "libindet/base/random.h"

namespace indet {

namespace {

/// Of the values that are known.
struct CountedMean {
  double mean = std::numeric_limits<double>::quiet_NaN();
  int count = 0;
};

CountedMean counted_mean(std::span<const double> values) {
  CountedMean result;
  double sum = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++result.count;
  }
  if (result.count > 0) result.mean = sum / result.count;
  return result;
}

}  // namespace

Estimate mean_of(std::span<const double> values) {
  const auto [mean, count] = counted_mean(values);
  Estimate estimate;
  estimate.value = mean;
  if (count > 1) estimate.error = standard_deviation(values) / std::sqrt(count);
  return estimate;
}

double standard_deviation(std::span<const double> values) {
  const auto [mean, count] = counted_mean(values);
  if (count < 2) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0;
  for (const double value : values) {
    if (!std::isnan(value)) squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / (count - 1));
}

Estimate bootstrap(int groups, const std::function<double(std::span<const double>)>& statistic,
                   const BootstrapOptions& options) {
  Estimate estimate;
  if (groups < 1) return estimate;
  std::vector<double> weights(static_cast<std::size_t>(groups), 1.0);
  estimate.value = statistic(weights);
  if (groups < 2) return estimate;
  Random random(options.seed);
  std::vector<double> values;
  for (int i = 0; i < options.resamples; ++i) {
    weights.assign(weights.size(), 0.0);
    for (int draw = 0; draw < groups; ++draw) {
      weights[static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(groups)))] += 1;
    }
    values.push_back(statistic(weights));
  }
  estimate.error = standard_deviation(values);
  return estimate;
}

}  // namespace indet
