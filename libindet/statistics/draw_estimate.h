#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "libindet/statistics/sample_estimate.h"

namespace indet {

/// A member of a population that was drawn `times` times, each time with this probability.
struct DrawnValue {
  double value = 0;
  double probability = 0;
  int times = 1;
  double prediction = 0;  ///< of the value, from what is known of all members
};

/// K draws with replacement from a population of M, of which member i has the probability p_i (Hansen and
/// Hurwitz, Ann. Math. Stat. 14, 333 (1943)):
///
///   mean = Σ z_k / K,   z_k = y_k / (M p_k),   low, high = mean ∓ t_{K−1} s_z / √K
///
/// t by Student: where p is roughly proportional to y, z has neither tail nor skewness. Each draw counts,
/// however often its contact was drawn before.
///
/// What was seldom drawn weighs so much that the drawn values alone tell little of the distribution of y.
/// Where the probability follows a width σ that y is roughly proportional to, it is told by
///
///   F(v) = the fraction of the pairs of a draw k and a member i with σ_i y_k / σ_k ≤ v,
///
/// whose error does not vanish with K: `band` = kBandBias + kBandNoise / √K is no proven bound but one that
/// was measured (docs/accuracy.md), for v of all sizes at once.
///
/// No interval is given from fewer than kFewestForInterval draws. Precondition: values are not NaN.
SampleEstimate estimate_from_draws(const std::vector<DrawnValue>& values, int population);

/// The same with the regression estimator, for predictions x_i whose mean X over all members is known
/// (Särndal, Swensson and Wretman, Model Assisted Survey Sampling (1992), ch. 6, for draws with replacement):
/// z is regressed on u_k = x_k / (M p_k), by least squares over the draws, and taken at X, the mean that u
/// has over all draws that could be made.
///
///   mean = z̄ + b (X − ū),   b = Σ (u_k − ū) z_k / S,   S = Σ (u_k − ū)²
///   low, high = mean ∓ t_{K−2} √Σ (w_k e_k / (1 − h_k))²
///   e_k = z_k − z̄ − b (u_k − ū),   h_k = 1/K + (u_k − ū)²/S,   w_k = 1/K + (X − ū)(u_k − ū)/S
///
/// w_k is the weight of z_k in the mean, and e_k / (1 − h_k) how far z_k lies from the line through the other
/// draws, so that errors need not have the same variance (HC3 of MacKinnon and White, J. Econometrics 29, 305
/// (1985)). What x gets wrong costs accuracy alone; the bias vanishes with 1/K. The slope has to be told by
/// more than one draw: where u of all others, whichever is left out, vary by kLeastSpread ū at most (root
/// mean square), and where there are fewer than kFewestForRegression draws, the estimate is that of
/// estimate_from_draws. Preconditions: values are not NaN, predictions are finite and ≥ 0.
SampleEstimate estimate_by_regression(const std::vector<DrawnValue>& values, int population,
                                      double mean_prediction);

/// Which of the two an estimate is meant to be.
enum class DrawEstimator : std::uint8_t { kMean, kRegression };
inline constexpr std::array kDrawEstimators = {DrawEstimator::kMean, DrawEstimator::kRegression};
const char* to_string(DrawEstimator estimator);  ///< "mean", "regression".

inline constexpr double kLeastSpread = 1e-3;
/// Intervals from fewer cover as well, but those of δT are longer than without regression, half of the time.
inline constexpr int kFewestForRegression = 8;

inline constexpr double kBandBias = 0.15;
inline constexpr double kBandNoise = 0.2;

}  // namespace indet
