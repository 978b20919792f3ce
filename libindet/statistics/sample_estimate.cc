#include "libindet/statistics/sample_estimate.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "libindet/statistics/probability_laws.h"

namespace indet {
namespace {

/// W of W + γ W²/3 + γ² W³/27 + γ/6K = u, in a form that loses no digits for small γ.
double invert_hall(double u, double skewness, double count) {
  const double shifted = u - skewness / (6 * count);
  const double root = std::cbrt(1 + skewness * shifted);
  return 3 * shifted / (root * root + root + 1);
}

}  // namespace

SampleEstimate estimate_from_sample(const std::vector<double>& values, int population) {
  const auto count = static_cast<double>(values.size());
  const double fraction = count / population;
  SampleEstimate estimate;
  estimate.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  estimate.low = estimate.high = estimate.mean;
  estimate.band = 0;
  if (fraction >= 1) return estimate;
  estimate.band = std::sqrt((1 - (count - 1) / population) * std::log(2 / (1 - kConfidence)) / (2 * count));
  if (values.size() < kFewestForInterval || !std::isfinite(estimate.mean)) {
    estimate.low = estimate.high = std::numeric_limits<double>::quiet_NaN();
    return estimate;
  }
  double squares = 0;
  double cubes = 0;
  for (const double value : values) {
    const double above = value - estimate.mean;
    squares += above * above;
    cubes += above * above * above;
  }
  const double deviation = std::sqrt(squares / (count - 1));
  if (deviation == 0) return estimate;
  const double skewness = cubes / count / (deviation * deviation * deviation);
  const double quantile = student_quantile(count - 1, 0.5 + kConfidence / 2) / std::sqrt(count);
  const double unit = deviation * std::sqrt(1 - fraction);
  estimate.low -= unit * invert_hall(quantile, skewness, count);
  estimate.high -= unit * invert_hall(-quantile, skewness, count);
  return estimate;
}

}  // namespace indet
