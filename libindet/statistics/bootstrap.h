#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

namespace indet {

/// A number with its standard error; NaN where there are too few data.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// Mean of independent values and its standard error, s/√n with s² = Σ(x − x̄)²/(n − 1). NaN values are left
/// out. The error is NaN for fewer than two values.
Estimate mean_of(std::span<const double> values);

/// s of mean_of.
double standard_deviation(std::span<const double> values);

/// Bootstrap over groups (B. Efron, Ann. Stat. 7, 1 (1979)): data of one group, here the packings of one
/// seed, depend on each other, data of different groups do not. Each of `resamples` draws `groups` groups
/// with replacement, so that group g counts w_g times; the standard error of a statistic is the standard
/// deviation of statistic(w) over the resamples, and its value is that for w = 1.
struct BootstrapOptions {
  int resamples = 200;
  std::uint64_t seed = 1;
};

/// Resamples in which the statistic is NaN are left out. The error is NaN for fewer than two groups.
Estimate bootstrap(int groups, const std::function<double(std::span<const double> weights)>& statistic,
                   const BootstrapOptions& options = {});

}  // namespace indet
