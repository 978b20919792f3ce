#include "libindet/verify/estimate_check.h"

#include <cmath>

#include "libindet/statistics/probability_laws.h"

namespace indet {

void check_estimate(const SampleEstimate& stored, const std::vector<double>& values, int contacts,
                    const std::string& name, Comparisons& compare) {
  const auto count = static_cast<double>(values.size());
  const double left_out = 1 - count / contacts;
  double sum = 0;
  double pairs = 0;
  double leaning = 0;
  for (const double a : values) sum += a;
  const double mean = values.empty() ? Verification::kNaN : sum / count;
  for (const double a : values) {
    for (const double b : values) {
      pairs += (a - b) * (a - b);
      leaning += (a - b) * (a - b) * (a + b - 2 * mean);
    }
  }
  const double s = std::sqrt(pairs / (2 * count * (count - 1)));
  const bool has_interval = left_out > 0 && count >= kFewestForInterval && std::isfinite(mean);
  if (has_interval && s > 0) {
    const double skewness = leaning / (2 * count * count * s * s * s);
    const double quantile = student_quantile(count - 1, (1 + kConfidence) / 2);
    const auto transformed = [&](double end) {
      const double w = (mean - end) / (s * std::sqrt(left_out));
      return w + skewness * w * w / 3 + skewness * skewness * w * w * w / 27 + skewness / (6 * count);
    };
    compare.equal(transformed(stored.low) * std::sqrt(count), quantile, "lower end of mean_" + name);
    compare.equal(transformed(stored.high) * std::sqrt(count), -quantile, "upper end of mean_" + name);
  } else {
    const double end = has_interval || left_out == 0 ? mean : Verification::kNaN;
    compare.equal(stored.low, end, "lower end of mean_" + name);
    compare.equal(stored.high, end, "upper end of mean_" + name);
  }
  const double band =
      std::sqrt(-std::log((1 - kConfidence) / 2) / 2 * (1 / count - (1 - 1 / count) / contacts));
  compare.equal(stored.mean, mean, "mean_" + name);
  compare.equal(stored.band, std::isnan(mean) ? mean : (left_out > 0 ? band : 0), "band_" + name);
}

}  // namespace indet
