#include "libindet/statistics/convergence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "libindet/statistics/probability_laws.h"

namespace indet {
namespace {

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Σ (x_i − m)(x_{i+lag} − m) / n.
double autocovariance(std::span<const double> centred, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = 0; i + lag < centred.size(); ++i) sum += centred[i] * centred[i + lag];
  return sum / static_cast<double>(centred.size());
}

/// Variance within chains W and the estimate var⁺ = (n − 1)/n W + B/n of the variance.
struct Variances {
  double within = 0;
  double total = 0;
};

Variances variances(std::span<const double> values, std::size_t length) {
  const std::size_t chains = values.size() / length;
  const auto n = static_cast<double>(length);
  std::vector<double> means(chains);
  Variances result;
  for (std::size_t c = 0; c < chains; ++c) {
    const auto chain = values.subspan(c * length, length);
    means[c] = mean(chain);
    double squares = 0;
    for (const double x : chain) squares += (x - means[c]) * (x - means[c]);
    result.within += squares / (n - 1) / static_cast<double>(chains);
  }
  const double grand = mean(means);
  double between = 0;
  for (const double m : means) between += (m - grand) * (m - grand);
  result.total = (n - 1) / n * result.within + between / static_cast<double>(chains - 1);
  return result;
}

double potential_scale_reduction(std::span<const double> values, std::size_t length) {
  const Variances v = variances(values, length);
  return v.within > 0 ? std::sqrt(v.total / v.within) : std::numeric_limits<double>::quiet_NaN();
}

/// Effective sample size by Geyer's initial monotone sequence of the autocorrelations
/// ρ_t = 1 − (W − mean autocovariance_t)/var⁺ of several chains.
double multi_chain_effective_size(std::span<const double> values, std::size_t length) {
  const std::size_t chains = values.size() / length;
  const auto total = static_cast<double>(values.size());
  const Variances v = variances(values, length);
  if (!(v.total > 0)) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> centred(values.begin(), values.end());
  for (std::size_t c = 0; c < chains; ++c) {
    const std::span<double> chain = std::span(centred).subspan(c * length, length);
    const double m = mean(chain);
    for (double& x : chain) x -= m;
  }
  const auto correlation = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t c = 0; c < chains; ++c)
      sum += autocovariance(std::span<const double>(centred).subspan(c * length, length), lag);
    const auto n = static_cast<double>(length);
    const double covariance = sum / static_cast<double>(chains) * n / (n - 1);
    return 1 - (v.within - covariance) / v.total;
  };
  double sum = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t lag = 0; lag + 1 < length; lag += 2) {
    const double pair = (lag == 0 ? 1.0 : correlation(lag)) + correlation(lag + 1);
    if (pair < 0) break;
    smallest = std::min(smallest, pair);
    sum += smallest;
  }
  // A negative correlation cannot make the samples worth more than S log S (as in the paper).
  const double time = std::max(2 * sum - 1, 1 / std::log10(total));
  return total / time;
}

std::vector<RankedValue> ranked(std::span<const double> values) {
  std::vector<RankedValue> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = {values[i], i};
  std::sort(result.begin(), result.end(),
            [](const RankedValue& a, const RankedValue& b) { return a.value < b.value; });
  return result;
}

/// Distances of values from a number between them: those below and those above it are in order already.
std::vector<RankedValue> ranked_distances(const std::vector<RankedValue>& ascending, double from) {
  std::vector<RankedValue> distances;
  distances.reserve(ascending.size());
  for (const RankedValue& r : ascending) distances.push_back({std::abs(r.value - from), r.index});
  const auto middle = std::partition_point(ascending.begin(), ascending.end(),
                                           [from](const RankedValue& r) { return r.value < from; });
  const auto above = distances.begin() + (middle - ascending.begin());
  std::reverse(distances.begin(), above);
  std::inplace_merge(distances.begin(), above, distances.end(),
                     [](const RankedValue& a, const RankedValue& b) { return a.value < b.value; });
  return distances;
}

}  // namespace

double sorted_quantile(std::span<const double> ascending, double q) {
  const double place = q * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= ascending.size()) return ascending.back();
  return std::lerp(ascending[below], ascending[below + 1], place - static_cast<double>(below));
}

ChainAssessor::ChainAssessor(int chains, int length) : chains_(chains), length_(length), half_(length / 2) {
  const std::size_t total = 2 * static_cast<std::size_t>(chains_) * static_cast<std::size_t>(half_);
  scores_.resize(2 * total - 1);
  for (std::size_t i = 0; i < scores_.size(); ++i) {
    const double rank = 1 + 0.5 * static_cast<double>(i);
    scores_[i] = normal_quantile((rank - 0.375) / (static_cast<double>(total) + 0.25));
  }
}

std::vector<double> ChainAssessor::halves(std::span<const double> values) const {
  std::vector<double> result;
  result.reserve(values.size());
  const auto length = static_cast<std::size_t>(length_);
  for (std::size_t c = 0; c < static_cast<std::size_t>(chains_); ++c) {
    const auto chain = values.subspan(c * length, length);
    result.insert(result.end(), chain.begin(), chain.begin() + half_);
    result.insert(result.end(), chain.end() - half_, chain.end());
  }
  return result;
}

std::vector<double> ChainAssessor::normal_scores(const std::vector<RankedValue>& ascending) const {
  std::vector<double> scores(ascending.size());
  for (std::size_t first = 0; first < ascending.size();) {
    std::size_t last = first;
    while (last + 1 < ascending.size() && ascending[last + 1].value == ascending[first].value) ++last;
    // Equal values share the mean of their ranks first + 1 … last + 1.
    for (std::size_t i = first; i <= last; ++i) scores[ascending[i].index] = scores_[first + last];
    first = last + 1;
  }
  return scores;
}

Convergence ChainAssessor::assess(std::span<const double> values) const {
  Convergence result;
  const std::vector<double> split = halves(values);
  const auto length = static_cast<std::size_t>(half_);
  const std::vector<RankedValue> ascending = ranked(split);
  if (ascending.front().value == ascending.back().value) return result;
  std::vector<double> sorted(split.size());
  std::transform(ascending.begin(), ascending.end(), sorted.begin(),
                 [](const RankedValue& r) { return r.value; });

  const std::vector<double> scores = normal_scores(ascending);
  result.bulk = multi_chain_effective_size(scores, length);
  const double folded = potential_scale_reduction(
      normal_scores(ranked_distances(ascending, sorted_quantile(sorted, 0.5))), length);
  result.rhat = std::fmax(potential_scale_reduction(scores, length), folded);

  std::vector<double> part(split.size());
  result.tail = std::numeric_limits<double>::infinity();
  for (const double q : {0.05, 0.95}) {
    const double limit = sorted_quantile(sorted, q);
    for (std::size_t i = 0; i < split.size(); ++i) part[i] = split[i] <= limit ? 1 : 0;
    // Where the values have an atom at the limit the indicator can be constant, and says nothing.
    result.tail = std::fmin(result.tail, multi_chain_effective_size(part, length));
  }
  return result;
}

double ChainAssessor::effective_size(std::span<const double> values) const {
  return multi_chain_effective_size(halves(values), static_cast<std::size_t>(half_));
}

}  // namespace indet
