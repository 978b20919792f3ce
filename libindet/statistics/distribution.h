#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "libindet/statistics/bootstrap.h"

namespace indet {

/// Values, each of which belongs to a group 0 … groups − 1 (a seed). `counts` says how often a value was
/// found; empty: once.
struct GroupedValues {
  std::vector<double> values;
  std::vector<int> group;
  std::vector<double> counts;
  int groups = 0;

  void add(double value, int group_of_value, double count = 1);
  double total() const;  ///< Number of finite values.
};

/// A probability density: density_k = n_k/(n · width) over [low + k width, low + (k + 1) width), where n
/// counts all finite values, those outside of the bins included. Its integral over the bins is therefore the
/// fraction of values inside, 1 if all are. `error` is the standard error by bootstrap over groups.
struct Histogram {
  double low = 0;
  double width = 1;
  std::vector<double> density, error;
  double total = 0;    ///< n.
  double outside = 0;  ///< Finite values outside of the bins.

  double center(std::size_t bin) const { return low + (static_cast<double>(bin) + 0.5) * width; }
};

/// Preconditions: width > 0, bins ≥ 1. The last bin includes its upper end.
Histogram histogram(const GroupedValues& data, double low, double width, int bins,
                    const BootstrapOptions& options = {});

/// Exponential tail: for x > from, p(x) ∝ exp(−(x − from)/λ). The maximum-likelihood estimate is the mean
/// excess, λ = ⟨x − from⟩; the error is a bootstrap over groups.
struct TailFit {
  Estimate decay;  ///< λ.
  double from = 0;
  double to = 0;      ///< Largest value.
  double values = 0;  ///< Number of values beyond `from`.
};
TailFit fit_tail(const GroupedValues& data, double from, const BootstrapOptions& options = {});

/// Position of the highest maximum of a histogram with bins of `width` in `from` … `to`, smoothed by the
/// weights 1, 2, 3, 2, 1, as the vertex of the parabola through the highest bin and its neighbours. NaN where
/// no bin is higher than its neighbours.
Estimate position_of_maximum(const GroupedValues& data, double from, double to, double width,
                             const BootstrapOptions& options = {});

/// The smallest value that at least a fraction `p` of all finite values do not exceed; NaN without values.
double quantile(const GroupedValues& data, double p);

/// Fraction of the values in [low, high).
Estimate fraction_between(const GroupedValues& data, double low, double high,
                          const BootstrapOptions& options = {});

/// Mean of all finite values; its error is a bootstrap over groups.
Estimate grouped_mean(const GroupedValues& data, const BootstrapOptions& options = {});

/// The distance of Kolmogorov and Smirnov, sup |P_a(x) − P_b(x)| of the cumulative distributions of the
/// finite values.
double kolmogorov_distance(const GroupedValues& a, const GroupedValues& b);

}  // namespace indet
