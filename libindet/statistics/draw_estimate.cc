#include "libindet/statistics/draw_estimate.h"

#include <algorithm>
#include <cmath>

#include "libindet/statistics/probability_laws.h"

namespace indet {
namespace {

/// Σ over draws.
template <class Term>
double sum(const std::vector<DrawnValue>& values, Term term) {
  double result = 0;
  for (const DrawnValue& drawn : values) result += drawn.times * term(drawn);
  return result;
}

void set_interval(SampleEstimate& estimate, double degrees, double error) {
  const double reach = student_quantile(degrees, 0.5 + kConfidence / 2) * error;
  estimate.low = estimate.mean - reach;
  estimate.high = estimate.mean + reach;
}

}  // namespace

const char* to_string(DrawEstimator estimator) {
  return estimator == DrawEstimator::kMean ? "mean" : "regression";
}

SampleEstimate estimate_from_draws(const std::vector<DrawnValue>& values, int population) {
  const auto z = [&](const DrawnValue& drawn) { return drawn.value / (population * drawn.probability); };
  const double draws = sum(values, [](const DrawnValue&) { return 1; });
  SampleEstimate estimate;
  estimate.mean = sum(values, z) / draws;
  estimate.band = kBandBias + kBandNoise / std::sqrt(draws);
  if (draws < kFewestForInterval || !std::isfinite(estimate.mean)) return estimate;
  const double squares = sum(values, [&](const DrawnValue& drawn) {
    return (z(drawn) - estimate.mean) * (z(drawn) - estimate.mean);
  });
  set_interval(estimate, draws - 1, std::sqrt(squares / (draws - 1) / draws));
  return estimate;
}

SampleEstimate estimate_by_regression(const std::vector<DrawnValue>& values, int population,
                                      double mean_prediction) {
  SampleEstimate estimate = estimate_from_draws(values, population);
  const double draws = sum(values, [](const DrawnValue&) { return 1; });
  if (draws < kFewestForRegression || !std::isfinite(estimate.mean)) return estimate;
  const double mean_z = estimate.mean;
  const auto z = [&](const DrawnValue& drawn) { return drawn.value / (population * drawn.probability); };
  const auto u = [&](const DrawnValue& drawn) { return drawn.prediction / (population * drawn.probability); };
  const double mean_u = sum(values, u) / draws;
  const auto away = [&](const DrawnValue& drawn) { return u(drawn) - mean_u; };
  const double squares = sum(values, [&](const DrawnValue& drawn) { return away(drawn) * away(drawn); });
  double largest = 0;
  for (const DrawnValue& drawn : values) largest = std::max(largest, std::abs(away(drawn)));
  // Leaving a draw out takes away(k)² K/(K − 1) from the sum of squares.
  const double least = (draws - 1) * kLeastSpread * kLeastSpread * mean_u * mean_u;
  if (!(squares - largest * largest * draws / (draws - 1) > least)) return estimate;

  const double slope = sum(values, [&](const DrawnValue& drawn) { return away(drawn) * z(drawn); }) / squares;
  const double missing = mean_prediction - mean_u;
  estimate.mean = mean_z + slope * missing;
  const double variance = sum(values, [&](const DrawnValue& drawn) {
    const double residual = z(drawn) - mean_z - slope * away(drawn);
    const double leverage = 1 / draws + away(drawn) * away(drawn) / squares;
    const double weight = 1 / draws + missing * away(drawn) / squares;
    const double error = weight * residual / (1 - leverage);
    return error * error;
  });
  set_interval(estimate, draws - 2, std::sqrt(variance));
  return estimate;
}

}  // namespace indet
