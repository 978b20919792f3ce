#include "libindet/statistics/draw_estimate.h"

#include <cmath>
#include <limits>

#include "libindet/statistics/probability_laws.h"

namespace indet {

SampleEstimate estimate_from_draws(const std::vector<DrawnValue>& values, int population) {
  double draws = 0;
  double sum = 0;
  const auto scaled = [&](const DrawnValue& drawn) { return drawn.value / (population * drawn.probability); };
  for (const DrawnValue& drawn : values) {
    draws += drawn.times;
    sum += drawn.times * scaled(drawn);
  }
  SampleEstimate estimate;
  estimate.mean = sum / draws;
  estimate.band = kBandBias + kBandNoise / std::sqrt(draws);
  estimate.low = estimate.high = std::numeric_limits<double>::quiet_NaN();
  if (draws < kFewestForInterval || !std::isfinite(estimate.mean)) return estimate;
  double squares = 0;
  for (const DrawnValue& drawn : values)
    squares += drawn.times * (scaled(drawn) - estimate.mean) * (scaled(drawn) - estimate.mean);
  const double error = std::sqrt(squares / (draws - 1) / draws);
  const double reach = student_quantile(draws - 1, 0.5 + kConfidence / 2) * error;
  estimate.low = estimate.mean - reach;
  estimate.high = estimate.mean + reach;
  return estimate;
}

}  // namespace indet
