#pragma once

#include <span>

namespace indet {

/// Where one more residual of a kind is to be expected, from K that are known.
struct ResidualBand {
  double middle = 0;         ///< the prediction
  double low = 0, high = 0;  ///< it lies between these with the probability that was asked for
};

/// The fewest residuals that a conformal band of this coverage (in (0, 1)) can be made from: K ≥ coverage/(1
/// − coverage), 19 for 0.95.
int fewest_for_conformal(double coverage);

/// Full conformal prediction about the mean (Vovk, Gammerman, Shafer, Algorithmic Learning in a Random World,
/// 2005, ch. 2). With the new residual r taken in, m is the mean of K + 1 residuals, and r is in the band
/// unless it is one of the n that are furthest from m:
///
///   r in band  ⟺  |r_j − m| ≥ |r − m| for n of the K residuals j at least
///
///   m = (Σ r_j + r)/(K + 1),   n = ⌊(1 − coverage)(K + 1)⌋
///
/// Each of these conditions says that r lies between r_j and its mirror image r̄ − (K + 1)/(K − 1) (r_j − r̄),
/// r̄ the mean of the K, so that the ends are the n-th largest and n-th smallest of the ends of these
/// intervals. If all K + 1 residuals are exchangeable, whatever their law, the band holds the new one with
/// probability 1 − n/(K + 1) ≥ coverage, and not with more unless some are equal. Precondition:
/// fewest_for_conformal(coverage) residuals at least.
ResidualBand conformal_band(std::span<const double> residuals, double coverage);

/// What is known of residuals in general: that of an item is the sum of a part that all items of a sample
/// share, with mean 0 and this standard deviation, and of one of its own, whose standard deviation is 1.
/// `low` and `high` are those quantiles of a residual over its standard deviation, between which it lies with
/// the coverage of the band.
struct ResidualLaw {
  double shared = 0;
  double low = 0, high = 0;
};

/// From few residuals, or none, by that law: the shared part is taken to be normal, so that its mean is
/// r̄ K τ²/(K τ² + 1), τ the standard deviation that is shared, and what is left of the variance of a new
/// residual is v = 1 + τ²/(K τ² + 1); the band reaches from √v low to √v high about that mean.
ResidualBand band_by_law(std::span<const double> residuals, const ResidualLaw& law);

}  // namespace indet
