#include "libindet/statistics/distribution.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace indet {
namespace {

double count_of(const GroupedValues& data, std::size_t i) {
  return data.counts.empty() ? 1.0 : data.counts[i];
}

std::size_t group_of(const GroupedValues& data, std::size_t i) {
  return static_cast<std::size_t>(data.group[i]);
}

/// Number of values of each group in each bin; the last column counts all finite values.
std::vector<std::vector<double>> counts_by_group(const GroupedValues& data, double low, double width,
                                                 int bins) {
  const auto n = static_cast<std::size_t>(bins);
  std::vector<std::vector<double>> counts(static_cast<std::size_t>(data.groups),
                                          std::vector<double>(n + 1, 0.0));
  const double high = low + width * bins;
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    const double value = data.values[i];
    if (!std::isfinite(value)) continue;
    std::vector<double>& row = counts[group_of(data, i)];
    row[n] += count_of(data, i);
    if (value < low || value > high) continue;
    const auto bin = static_cast<std::size_t>((value - low) / width);
    row[std::min(bin, n - 1)] += count_of(data, i);
  }
  return counts;
}

double weighted(const std::vector<std::vector<double>>& counts, std::span<const double> weights,
                std::size_t column) {
  double sum = 0;
  for (std::size_t g = 0; g < counts.size(); ++g) sum += weights[g] * counts[g][column];
  return sum;
}

/// Sums of group g: Σ count · f and Σ count over the values that `f` accepts.
template <class Function>
std::vector<std::pair<double, double>> sums_by_group(const GroupedValues& data, Function f) {
  std::vector<std::pair<double, double>> sums(static_cast<std::size_t>(data.groups), {0.0, 0.0});
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    double term = 0;
    if (!std::isfinite(data.values[i]) || !f(data.values[i], term)) continue;
    sums[group_of(data, i)].first += count_of(data, i) * term;
    sums[group_of(data, i)].second += count_of(data, i);
  }
  return sums;
}

Estimate ratio(const std::vector<std::pair<double, double>>& sums, const BootstrapOptions& options) {
  return bootstrap(
      static_cast<int>(sums.size()),
      [&](std::span<const double> weights) {
        double above = 0;
        double below = 0;
        for (std::size_t g = 0; g < sums.size(); ++g) {
          above += weights[g] * sums[g].first;
          below += weights[g] * sums[g].second;
        }
        return below > 0 ? above / below : std::numeric_limits<double>::quiet_NaN();
      },
      options);
}

}  // namespace

void GroupedValues::add(double value, int group_of_value, double count) {
  if (count != 1 && counts.empty()) counts.assign(values.size(), 1.0);
  if (!counts.empty() || count != 1) counts.push_back(count);
  values.push_back(value);
  group.push_back(group_of_value);
  groups = std::max(groups, group_of_value + 1);
}

double GroupedValues::total() const {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::isfinite(values[i]) ? count_of(*this, i) : 0;
  return sum;
}

Histogram histogram(const GroupedValues& data, double low, double width, int bins,
                    const BootstrapOptions& options) {
  const auto n = static_cast<std::size_t>(bins);
  const auto counts = counts_by_group(data, low, width, bins);
  Histogram result{.low = low, .width = width, .density = {}, .error = {}, .total = 0, .outside = 0};
  const std::vector<double> ones(counts.size(), 1.0);
  result.total = weighted(counts, ones, n);
  double inside = 0;
  for (std::size_t bin = 0; bin < n; ++bin) {
    inside += weighted(counts, ones, bin);
    const Estimate density = bootstrap(
        data.groups,
        [&](std::span<const double> weights) {
          const double all = weighted(counts, weights, n);
          return all > 0 ? weighted(counts, weights, bin) / (all * width)
                         : std::numeric_limits<double>::quiet_NaN();
        },
        options);
    result.density.push_back(density.value);
    result.error.push_back(density.error);
  }
  result.outside = result.total - inside;
  return result;
}

TailFit fit_tail(const GroupedValues& data, double from, const BootstrapOptions& options) {
  TailFit fit;
  fit.from = fit.to = from;
  const auto sums = sums_by_group(data, [&](double x, double& term) {
    term = x - from;
    if (x > from) fit.to = std::max(fit.to, x);
    return x > from;
  });
  for (const auto& [excess, count] : sums) fit.values += count;
  fit.decay = ratio(sums, options);
  return fit;
}

Estimate position_of_maximum(const GroupedValues& data, double from, double to, double width,
                             const BootstrapOptions& options) {
  const int bins = std::max(1, static_cast<int>(std::ceil((to - from) / width)));
  const auto counts = counts_by_group(data, from, width, bins);
  const auto n = static_cast<std::ptrdiff_t>(bins);
  return bootstrap(
      data.groups,
      [&](std::span<const double> weights) {
        std::vector<double> raw;
        for (std::ptrdiff_t bin = 0; bin < n; ++bin)
          raw.push_back(weighted(counts, weights, static_cast<std::size_t>(bin)));
        std::vector<double> smooth(raw.size(), 0.0);
        for (std::ptrdiff_t bin = 0; bin < n; ++bin) {
          double norm = 0;
          for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, bin - 2); k <= std::min(n - 1, bin + 2); ++k) {
            const auto weight = static_cast<double>(3 - std::abs(k - bin));
            smooth[static_cast<std::size_t>(bin)] += weight * raw[static_cast<std::size_t>(k)];
            norm += weight;
          }
          smooth[static_cast<std::size_t>(bin)] /= norm;
        }
        // The highest bin that is higher than its neighbours: a density that only falls has no maximum.
        std::ptrdiff_t top = -1;
        for (std::ptrdiff_t bin = 1; bin + 1 < n; ++bin) {
          const double height = smooth[static_cast<std::size_t>(bin)];
          const bool peak = height > smooth[static_cast<std::size_t>(bin - 1)] &&
                            height >= smooth[static_cast<std::size_t>(bin + 1)];
          if (peak && (top < 0 || height > smooth[static_cast<std::size_t>(top)])) top = bin;
        }
        if (top < 0) return std::numeric_limits<double>::quiet_NaN();
        double shift = 0;
        {
          const double left = smooth[static_cast<std::size_t>(top - 1)];
          const double middle = smooth[static_cast<std::size_t>(top)];
          const double right = smooth[static_cast<std::size_t>(top + 1)];
          const double curvature = left - 2 * middle + right;
          if (curvature < 0) shift = 0.5 * (left - right) / curvature;
        }
        return from + (static_cast<double>(top) + 0.5 + shift) * width;
      },
      options);
}

double quantile(const GroupedValues& data, double p) {
  std::vector<std::pair<double, double>> sorted;
  double total = 0;
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    if (!std::isfinite(data.values[i])) continue;
    sorted.emplace_back(data.values[i], count_of(data, i));
    total += count_of(data, i);
  }
  std::sort(sorted.begin(), sorted.end());
  double below = 0;
  for (const auto& [value, count] : sorted) {
    below += count;
    if (below >= p * total) return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Estimate fraction_between(const GroupedValues& data, double low, double high,
                          const BootstrapOptions& options) {
  return ratio(sums_by_group(data,
                             [&](double x, double& term) {
                               term = x >= low && x < high ? 1 : 0;
                               return true;
                             }),
               options);
}

Estimate grouped_mean(const GroupedValues& data, const BootstrapOptions& options) {
  return ratio(sums_by_group(data,
                             [](double x, double& term) {
                               term = x;
                               return true;
                             }),
               options);
}

double kolmogorov_distance(const GroupedValues& a, const GroupedValues& b) {
  std::vector<std::pair<double, double>> steps;  // value, change of P_a − P_b
  const auto add_steps = [&](const GroupedValues& data, double sign) {
    const double total = data.total();
    for (std::size_t i = 0; i < data.values.size(); ++i) {
      if (std::isfinite(data.values[i])) steps.emplace_back(data.values[i], sign * count_of(data, i) / total);
    }
  };
  add_steps(a, 1);
  add_steps(b, -1);
  std::sort(steps.begin(), steps.end());
  double difference = 0;
  double largest = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    difference += steps[i].second;
    if (i + 1 == steps.size() || steps[i + 1].first != steps[i].first)
      largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

}  // namespace indet
