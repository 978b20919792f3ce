#pragma once

#include <vector>

#include "libindet/statistics/sample_estimate.h"

namespace indet {

/// A member of a population that was drawn `times` times, each time with this probability.
struct DrawnValue {
  double value = 0;
  double probability = 0;
  int times = 1;
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

inline constexpr double kBandBias = 0.15;
inline constexpr double kBandNoise = 0.2;

}  // namespace indet
