#include "libindet/verify/chain_diagnostics.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace indet {
namespace {

/// First and second halves of all chains as columns; of an odd number of rows the middle one is left out.
Eigen::MatrixXd half_chains(const Eigen::MatrixXd& draws) {
  const Eigen::Index half = draws.rows() / 2;
  Eigen::MatrixXd halves(half, 2 * draws.cols());
  halves << draws.topRows(half), draws.bottomRows(half);
  return halves;
}

/// Places of all numbers in ascending order.
std::vector<Eigen::Index> ascending(const Eigen::MatrixXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values.data()[a] < values.data()[b]; });
  return order;
}

/// Ranks 1, 2, …; equal numbers share their mean.
Eigen::MatrixXd ranks_of(const Eigen::MatrixXd& values) {
  const std::vector<Eigen::Index> order = ascending(values);
  Eigen::MatrixXd ranks(values.rows(), values.cols());
  std::size_t begin = 0;
  while (begin < order.size()) {
    std::size_t end = begin;
    while (end < order.size() && values.data()[order[end]] == values.data()[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i)
      ranks.data()[order[i]] = 0.5 * static_cast<double>(begin + 1 + end);
    begin = end;
  }
  return ranks;
}

/// Φ⁻¹((rank − 3/8)/(S + 1/4)), by the inverse error function.
Eigen::MatrixXd scores_of(const Eigen::MatrixXd& ranks) {
  const double total = static_cast<double>(ranks.size()) + 0.25;
  return ranks.unaryExpr([total](double rank) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * (rank - 0.375) / total);
  });
}

struct Spread {
  double within = 0, total = 0;  ///< W and var⁺
};

Spread spread_of(const Eigen::MatrixXd& chains) {
  const auto n = static_cast<double>(chains.rows());
  const auto m = static_cast<double>(chains.cols());
  const Eigen::RowVectorXd means = chains.colwise().mean();
  Spread spread;
  spread.within = (chains.rowwise() - means).squaredNorm() / (m * (n - 1));
  spread.total = (n - 1) / n * spread.within + (means.array() - means.mean()).square().sum() / (m - 1);
  return spread;
}

double rhat_of(const Eigen::MatrixXd& chains) {
  const Spread spread = spread_of(chains);
  return std::sqrt(spread.total / spread.within);
}

double effective_size(const Eigen::MatrixXd& chains) {
  const Spread spread = spread_of(chains);
  if (!(spread.total > 0)) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Index n = chains.rows();
  const Eigen::MatrixXd centred = chains.rowwise() - chains.colwise().mean();
  const auto autocorrelation = [&](Eigen::Index lag) {
    const double products = centred.topRows(n - lag).cwiseProduct(centred.bottomRows(n - lag)).sum();
    const double covariance = products / static_cast<double>((n - 1) * chains.cols());
    return 1 - (spread.within - covariance) / spread.total;
  };
  // Geyer: sums of neighbouring autocorrelations, as long as they are positive, made to decrease.
  double time = -1;
  double last = std::numeric_limits<double>::infinity();
  for (Eigen::Index lag = 0; lag + 1 < n; lag += 2) {
    const double sum = (lag > 0 ? autocorrelation(lag) : 1) + autocorrelation(lag + 1);
    if (sum < 0) break;
    last = std::min(last, sum);
    time += 2 * last;
  }
  const auto total = static_cast<double>(chains.size());
  return std::min(total / time, total * std::log10(total));
}

}  // namespace

ChainDiagnostics diagnose_chains(const Eigen::MatrixXd& draws) {
  const Eigen::MatrixXd halves = half_chains(draws);
  const Eigen::Index total = halves.size();
  const std::vector<Eigen::Index> order = ascending(halves);
  const auto at = [&](Eigen::Index place) { return order[static_cast<std::size_t>(place)]; };
  ChainDiagnostics result{};

  const Eigen::MatrixXd scores = scores_of(ranks_of(halves));
  result.bulk = effective_size(scores);

  // The number of values is even: the median lies between two of them.
  const Eigen::Index below = at(total / 2 - 1);
  const Eigen::Index above = at(total / 2);
  const double median = 0.5 * (halves.data()[below] + halves.data()[above]);
  Eigen::MatrixXd ranks = ranks_of((halves.array() - median).abs().matrix());
  const double sum = ranks.data()[below] + ranks.data()[above];
  constexpr std::array kFirst = {0.0, -0.5, 0.5};
  for (std::size_t i = 0; i < kFirst.size(); ++i) {
    ranks.data()[below] = 0.5 * sum + kFirst[i];
    ranks.data()[above] = 0.5 * sum - kFirst[i];
    result.rhat[i] = std::fmax(rhat_of(scores), rhat_of(scores_of(ranks)));
  }

  result.tail = std::numeric_limits<double>::infinity();
  for (const double level : {0.05, 0.95}) {
    const auto place = static_cast<Eigen::Index>(level * static_cast<double>(total - 1));
    const double limit = halves.data()[at(place)];
    const Eigen::MatrixXd is_below = (halves.array() <= limit).cast<double>().matrix();
    result.tail = std::fmin(result.tail, effective_size(is_below));
  }
  return result;
}

double effective_size_of_mean(const Eigen::MatrixXd& draws) { return effective_size(half_chains(draws)); }

}  // namespace indet
