#include "libindet/sampling/volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/sampling/random_streams.h"

namespace indet {
namespace {

constexpr double kWeightVariance = 0.25;
constexpr double kInsideFraction = 0.5;
constexpr int kNormalPoints = 8000;
constexpr int kMostPhases = 10000;

/// ‖y‖² of one chain at one a_i.
using Squares = std::vector<double>;

/// Mean and relative variance of exp(−Δ q/2), q over all chains.
struct Weights {
  double mean = 0;
  double variance = 0;
};

Weights weights(const std::vector<Squares>& squares, double step) {
  double sum = 0;
  double second = 0;
  double count = 0;
  for (const Squares& chain : squares) {
    for (const double q : chain) {
      const double w = std::exp(-step * q / 2);
      sum += w;
      second += w * w;
    }
    count += static_cast<double>(chain.size());
  }
  const double mean = sum / count;
  return {mean, second / count / (mean * mean) - 1};
}

/// The step of a that gives weights their intended variance.
double choose_step(const std::vector<Squares>& squares) {
  double mean = 0;
  double count = 0;
  for (const Squares& chain : squares) {
    for (const double q : chain) mean += q;
    count += static_cast<double>(chain.size());
  }
  mean /= count;
  double low = 0;
  double high = 1 / mean;
  while (weights(squares, high).variance < kWeightVariance) high *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (weights(squares, middle).variance < kWeightVariance ? low : high) = middle;
  }
  return low;
}

double fraction_inside(const RoundedBody& body, double precision, int points, Random random) {
  int inside = 0;
  Eigen::VectorXd y(body.dim());
  for (int i = 0; i < points; ++i) {
    for (double& component : y) component = random.normal() / std::sqrt(precision);
    inside += (body.offset + body.slope * y).minCoeff() >= 0 ? 1 : 0;
  }
  return static_cast<double>(inside) / points;
}

/// Σ_i log of the mean over chains of the weights at each a_i, all chains but `left_out` (−1: none).
double log_ratio(const std::vector<std::vector<double>>& chain_weights, int left_out) {
  double result = 0;
  for (const std::vector<double>& phase : chain_weights) {
    double sum = 0;
    for (std::size_t c = 0; c < phase.size(); ++c) sum += static_cast<int>(c) == left_out ? 0 : phase[c];
    result += std::log(sum / static_cast<double>(phase.size() - (left_out < 0 ? 0 : 1)));
  }
  return result;
}

}  // namespace

VolumeEstimate estimate_volume(const ConvexBody& body, const UniformSample& sample,
                               const VolumeOptions& options) {
  const Rounding& rounding = sample.rounding.rounding;
  const RoundedBody rounded(body, rounding);
  std::vector<CoordinateWalk> walks;
  for (int c = 0; c < options.chains; ++c) {
    const Eigen::Index i = static_cast<Eigen::Index>(c) * sample.count() / options.chains;
    const Eigen::VectorXd y =
        rounding.transform.triangularView<Eigen::Lower>().solve(sample.z.col(i) - rounding.center);
    walks.emplace_back(rounded, y, random_of(options.seed, ChainKind::kVolume, c));
  }
  WorkerTeam team(std::clamp(options.threads, 1, options.chains));
  std::vector<std::vector<double>> chain_weights;  // mean weight of each chain, for each a_i
  VolumeEstimate estimate;
  double precision = 0;
  double inside = 0;
  for (;; ++estimate.phases) {
    if (estimate.phases == kMostPhases) throw LibraryError("the annealing of the volume does not end");
    if (precision > 0) {
      const Random random = random_of(options.seed, ChainKind::kVolume, options.chains + estimate.phases);
      inside = fraction_inside(rounded, precision, kNormalPoints, random);
      if (inside >= kInsideFraction) break;
    }
    std::vector<Squares> squares(walks.size());
    team.run(options.chains, [&](int, std::int64_t chain) {
      const auto c = static_cast<std::size_t>(chain);
      for (int i = 0; i < options.sweeps; ++i) {
        if (i % 64 == 0) walks[c].refresh();
        walks[c].sweep(precision);
        // The density has just become a little narrower; a tenth of the sweeps follow it.
        if (i >= options.sweeps / 10) squares[c].push_back(walks[c].position().squaredNorm());
      }
    });
    const double step = choose_step(squares);
    std::vector<double>& phase = chain_weights.emplace_back();
    for (const Squares& chain : squares) phase.push_back(weights({chain}, step).mean);
    precision += step;
    if (options.progress && !options.progress({"volume", estimate.phases, 0, {}})) throw Interrupted();
  }
  const double n = body.dim();
  estimate.log_volume = n * std::log(body.units.internal_in_weights()) + rounding.log_determinant() +
                        n / 2 * std::log(2 * std::numbers::pi / precision) + std::log(inside) -
                        log_ratio(chain_weights, -1);
  std::vector<double> without(walks.size());
  double mean = 0;
  for (int c = 0; c < options.chains; ++c) {
    without[static_cast<std::size_t>(c)] = log_ratio(chain_weights, c);
    mean += without[static_cast<std::size_t>(c)] / options.chains;
  }
  double variance = 0;
  for (const double value : without) variance += (value - mean) * (value - mean);
  variance *= (options.chains - 1.0) / options.chains;
  estimate.error = std::sqrt(variance + (1 - inside) / (inside * kNormalPoints));
  return estimate;
}

}  // namespace indet
