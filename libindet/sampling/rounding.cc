#include "libindet/sampling/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/error.h"
#include "libindet/dense/symmetric.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "libindet/sampling/random_streams.h"

namespace indet {
namespace {

/// The Dikin ellipsoid becomes the unit ball.
Rounding dikin_rounding(const ConvexBody& body, const AnalyticCenter& center) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(body.dim(), body.dim());
  return {center.z, center.root.triangularView<Eigen::Lower>().solve(identity)};
}

/// Applies the covariance of y, by block, to the rounding. Returns the ratio of standard deviations.
double apply_covariance(const ConvexBody& body, const Eigen::VectorXd& mean,
                        const Eigen::MatrixXd& covariance, Rounding& rounding) {
  double largest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  rounding.center += rounding.transform * mean;
  for (const BodyBlock& block : body.blocks) {
    const Eigen::MatrixXd part =
        covariance.block(block.first_column, block.first_column, block.columns, block.columns);
    const Eigen::VectorXd values = eigenvalues_of(part);
    largest = std::max(largest, values[values.size() - 1]);
    smallest = std::min(smallest, values[0]);
    const Eigen::MatrixXd root = cholesky_factor(part);
    auto square =
        rounding.transform.block(block.first_column, block.first_column, block.columns, block.columns);
    square = (square * root).eval();
  }
  if (!(smallest > 0)) throw LibraryError("the warm-up of the sampling did not move in every direction");
  return std::sqrt(largest / smallest);
}

struct Moments {
  Eigen::VectorXd sum;
  Eigen::MatrixXd products;
  std::int64_t count = 0;
};

}  // namespace

RoundingResult round_body(const ConvexBody& body, const Eigen::VectorXd& interior,
                          const RoundingOptions& options, WorkerTeam& team) {
  RoundingResult result;
  result.rounding = dikin_rounding(body, find_analytic_center(body, interior));
  const Eigen::Index n = body.dim();
  const auto chains = static_cast<std::size_t>(options.chains);
  std::vector<Eigen::VectorXd> positions(chains, result.rounding.center);  // z
  // Enough for a covariance of n directions, even if many sweeps lie between independent samples.
  std::int64_t sweeps = 16 * n + 100;
  for (int phase = 0; phase < options.most_phases; ++phase, sweeps *= 2) {
    const std::int64_t between = std::max<std::int64_t>(1, sweeps / (16 * n + 100));
    const RoundedBody rounded(body, result.rounding);
    const auto triangular = result.rounding.transform.triangularView<Eigen::Lower>();
    std::vector<Moments> moments(chains);
    team.run(options.chains, [&](int, std::int64_t chain) {
      const auto c = static_cast<std::size_t>(chain);
      CoordinateWalk walk(rounded, triangular.solve(positions[c] - result.rounding.center),
                          random_of(options.seed, ChainKind::kRounding, chain + options.chains * phase));
      Moments& m = moments[c];
      m = {Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n), 0};
      for (std::int64_t i = 0; i < sweeps; ++i) {
        walk.sweep();
        if (i % 64 == 0) walk.refresh();
        if (i < sweeps / 8 || i % between != 0) continue;
        m.sum += walk.position();
        m.products.selfadjointView<Eigen::Lower>().rankUpdate(walk.position());
        ++m.count;
      }
      positions[c] = result.rounding.center + triangular * walk.position();
    });
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
    double count = 0;
    for (const Moments& m : moments) {
      mean += m.sum;
      products += m.products;
      count += static_cast<double>(m.count);
    }
    mean /= count;
    const Eigen::MatrixXd lower = products / count - mean * mean.transpose();
    result.ratio = apply_covariance(body, mean, lower.selfadjointView<Eigen::Lower>(), result.rounding);
    result.phases = phase + 1;
    result.sweeps += sweeps * options.chains;
    if (result.ratio < options.settled) break;
  }
  return result;
}

Eigen::MatrixXd dispersed_points(const ConvexBody& body, const Eigen::VectorXd& interior, int count,
                                 std::uint64_t seed) {
  constexpr double kTowardsVertex = 0.9;
  Eigen::MatrixXd points(body.dim(), count);
  for (int c = 0; c < count; ++c) {
    Random random = random_of(seed, ChainKind::kStart, c);
    Eigen::VectorXd guide(body.dim());
    for (double& component : guide) component = random.normal();
    const Vertex vertex = compute_vertex(body.view, purify_to_vertex(body.view, interior, guide));
    points.col(c) = interior + kTowardsVertex * (vertex.z - interior);
    // Rounding can put a vertex outside of a very thin body: then the chain starts nearer.
    for (int halvings = 0; !(body.slack(points.col(c)) > 0) && halvings < 60; ++halvings)
      points.col(c) = (points.col(c) + interior) / 2;
  }
  return points;
}

}  // namespace indet
