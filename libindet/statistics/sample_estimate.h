#pragma once

#include <limits>
#include <vector>

namespace indet {

/// What a sample tells about the population that it was drawn from.
struct SampleEstimate {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = mean, high = mean;  ///< confidence interval of the population's mean; NaN: too few values
  double band = mean;  ///< the fraction of the population with a value ≤ v lies within ± band of the
                       ///< sample's, for all v at once
};
/// The level of confidence of intervals and bands.
inline constexpr double kConfidence = 0.95;
/// Fewer values tell no interval: that of 5 covers the mean of δR less often than in 90 of 100 cases.
inline constexpr int kFewestForInterval = 6;

/// K values, drawn without replacement from `population` (M) ones, f = K/M.
///
///   low, high = mean − s √(1 − f) W,   W + γ W²/3 + γ² W³/27 + γ/6K = ± t_{K−1} / √K
///   band = √((1 − (K − 1)/M) ln(2/α) / 2K),   α = 1 − 0.95
///
/// δ is skewed (skewness γ), so that Student's t covers its mean too seldom. The interval is that of P.
/// Hall's transformation of t (J. R. Stat. Soc. B 54, 221 (1992)), which is free of skewness, with the finite
/// population correction; where γ = 0 it is Student's. The band is that of Dvoretzky, Kiefer and Wolfowitz
/// with Serfling's correction.
///
/// docs/accuracy.md has the measured coverage. An infinite value makes the mean infinite and its interval
/// NaN, as fewer than kFewestForInterval values of a larger population do. Precondition: K ≥ 1; no NaN.
SampleEstimate estimate_from_sample(const std::vector<double>& values, int population);

}  // namespace indet
