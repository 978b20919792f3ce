#include "libindet/statistics/two_sample.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/statistics/probability_laws.h"

namespace indet {
namespace {

struct Moments {
  double mean = 0;
  double variance_of_mean = 0;
};

Moments moments_of(const CorrelatedSample& sample) {
  const auto n = static_cast<double>(sample.values.size());
  Moments m;
  for (const double x : sample.values) m.mean += x / n;
  double squares = 0;
  for (const double x : sample.values) squares += (x - m.mean) * (x - m.mean);
  m.variance_of_mean = squares / (n - 1) / sample.effective;
  return m;
}

std::vector<double> ascending(std::span<const double> values) {
  std::vector<double> result(values.begin(), values.end());
  std::sort(result.begin(), result.end());
  return result;
}

double largest_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == x) ++i;
    while (j < b.size() && b[j] == x) ++j;
    largest = std::max(largest, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                         static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return largest;
}

std::vector<double> known(std::span<const double> values) {
  std::vector<double> result;
  std::copy_if(values.begin(), values.end(), std::back_inserter(result),
               [](double v) { return !std::isnan(v); });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TwoSampleTest compare_samples(const CorrelatedSample& a, const CorrelatedSample& b) {
  TwoSampleTest test;
  if (!(a.effective > 2 && b.effective > 2) || a.values.size() < 2 || b.values.size() < 2) return test;
  const Moments in_a = moments_of(a);
  const Moments in_b = moments_of(b);
  test.difference = in_a.mean - in_b.mean;
  const double variance = in_a.variance_of_mean + in_b.variance_of_mean;
  test.error = std::sqrt(variance);
  test.distance = largest_distance(ascending(a.values), ascending(b.values));
  // Anticorrelated values know their mean better than independent ones, but not their distribution.
  const double n_a = std::min(a.effective, static_cast<double>(a.values.size()));
  const double n_b = std::min(b.effective, static_cast<double>(b.values.size()));
  test.p_distribution = kolmogorov_probability(test.distance, n_a * n_b / (n_a + n_b));
  if (!(variance > 0)) return test;
  const double freedom = variance * variance /
                         (in_a.variance_of_mean * in_a.variance_of_mean / (a.effective - 1) +
                          in_b.variance_of_mean * in_b.variance_of_mean / (b.effective - 1));
  test.p_mean = student_two_sided(freedom, std::abs(test.difference) / test.error);
  return test;
}

double kolmogorov_probability(double distance, double n) {
  const double lambda = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
  if (lambda < 0.2) return 1;  // to 1e-12; the series alternates too long
  double sum = 0;
  double sign = 1;
  for (int k = 1; k <= 100; ++k) {
    const double term = std::exp(-2 * k * k * lambda * lambda);
    sum += sign * term;
    if (term < 1e-16) break;
    sign = -sign;
  }
  return std::clamp(2 * sum, 0.0, 1.0);
}

double uniformity_probability(std::span<const double> values) {
  const std::vector<double> sorted = known(values);
  const auto n = static_cast<double>(sorted.size());
  if (sorted.size() < 4) return std::numeric_limits<double>::quiet_NaN();
  double distance = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double x = std::clamp(sorted[i], 0.0, 1.0);
    distance = std::max({distance, x - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - x});
  }
  return kolmogorov_probability(distance, n);
}

int count_discoveries(std::span<const double> p_values, double rate) {
  const std::vector<double> sorted = known(p_values);
  const auto m = static_cast<double>(sorted.size());
  for (std::size_t i = sorted.size(); i > 0; --i) {
    if (sorted[i - 1] <= rate * static_cast<double>(i) / m) return static_cast<int>(i);
  }
  return 0;
}

}  // namespace indet
