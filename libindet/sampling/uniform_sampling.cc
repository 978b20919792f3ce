#include "libindet/sampling/uniform_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/sampling/random_streams.h"

namespace indet {
namespace {

using Clock = std::chrono::steady_clock;

/// One chain: what it recorded, at sweeps interval, 2 interval, …
struct Chain {
  CoordinateWalk walk;
  Eigen::MatrixXd z;
  int recorded = 0;
  double worst_slack = std::numeric_limits<double>::infinity();
};

/// Forgets every other sample, so that those left are twice as many sweeps apart.
void thin(Chain& chain) {
  for (int i = 0; 2 * i + 1 < chain.recorded; ++i) chain.z.col(i) = chain.z.col(2 * i + 1).eval();
  chain.recorded /= 2;
}

class Sampler {
 public:
  Sampler(const ConvexBody& body, const UniformOptions& options)
      : body_(body), options_(options), team_(std::clamp(options.threads, 1, options.chains)) {}

  UniformSample run() {
    const auto begin = Clock::now();
    const std::clock_t core_begin = std::clock();
    result_.chains = options_.chains;
    result_.interval = 1;
    result_.ball = find_inscribed_ball(body_);
    RoundingOptions rounding;
    rounding.chains = options_.chains;
    rounding.seed = options_.seed;
    result_.rounding = round_body(body_, result_.ball.center, rounding, team_);
    const RoundedBody rounded(body_, result_.rounding.rounding);
    start(rounded);
    walk_until_converged();
    finish();
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    result_.core_seconds = static_cast<double>(std::clock() - core_begin) / CLOCKS_PER_SEC;
    return std::move(result_);
  }

 private:
  void start(const RoundedBody& rounded) {
    const Eigen::MatrixXd points =
        dispersed_points(body_, result_.ball.center, options_.chains, options_.seed);
    const Rounding& rounding = result_.rounding.rounding;
    // Room for eight samples for each effective one that is asked for.
    capacity_ = std::max(1000, 2 * static_cast<int>(std::ceil(4 * options_.effective / options_.chains)));
    for (int c = 0; c < options_.chains; ++c) {
      const Eigen::VectorXd y =
          rounding.transform.triangularView<Eigen::Lower>().solve(points.col(c) - rounding.center);
      chains_.push_back({CoordinateWalk(rounded, y, random_of(options_.seed, ChainKind::kUniform, c)),
                         Eigen::MatrixXd(body_.dim(), capacity_)});
    }
  }

  void walk_until_converged() {
    const std::int64_t first = 256;
    std::int64_t target = first;  // sweeps of a chain
    for (;;) {
      target = std::min(target, options_.limit);
      while (result_.sweeps < target) {
        if (chains_.front().recorded == capacity_) {
          for (Chain& chain : chains_) thin(chain);
          result_.interval *= 2;
        }
        const int room = capacity_ - chains_.front().recorded;
        const std::int64_t wanted = (target - result_.sweeps + result_.interval - 1) / result_.interval;
        advance(static_cast<int>(std::min<std::int64_t>({room, wanted, kRound})));
        report(target);
      }
      cut_warm_up();
      const double reached = smallest_effective_size_so_far();
      if (reached >= options_.effective) {
        result_.converged = true;
        return;
      }
      if (result_.sweeps >= options_.limit) return;
      const double factor = reached > 0 ? options_.effective / reached : 2.0;
      target = std::max(result_.sweeps + 1, static_cast<std::int64_t>(static_cast<double>(result_.sweeps) *
                                                                      std::clamp(1.1 * factor, 1.15, 2.0)));
    }
  }

  void advance(int samples) {
    const Rounding& rounding = result_.rounding.rounding;
    team_.run(options_.chains, [&](int, std::int64_t c) {
      Chain& chain = chains_[static_cast<std::size_t>(c)];
      for (int i = 0; i < samples; ++i) {
        for (std::int64_t sweep = 0; sweep < result_.interval; ++sweep) {
          if (sweep % kRefresh == 0) chain.walk.refresh();
          chain.walk.sweep();
        }
        auto z = chain.z.col(chain.recorded++);
        z = rounding.center + rounding.transform.triangularView<Eigen::Lower>() * chain.walk.position();
        chain.worst_slack = std::min(chain.worst_slack, body_.slack(z));
      }
    });
    result_.sweeps += samples * result_.interval;
    result_.worst_slack = std::numeric_limits<double>::infinity();
    for (const Chain& chain : chains_) result_.worst_slack = std::min(result_.worst_slack, chain.worst_slack);
    const double scale = std::max(1.0, body_.view.offset.lpNorm<Eigen::Infinity>());
    if (!(result_.worst_slack >= -tolerance::kSampleResidual * scale)) {
      throw LibraryError(fmt::format("a sample is outside of the polytope by {:.1e}", -result_.worst_slack));
    }
  }

  void report(std::int64_t target) const {
    if (!options_.progress) return;
    const std::string details =
        last_reached_ > 0 ? fmt::format("{:.0f} of {:.0f} effective", last_reached_, options_.effective) : "";
    if (!options_.progress({"sample", result_.sweeps, target, details})) throw Interrupted();
  }

  /// The samples without the first fifth of each chain.
  void cut_warm_up() {
    const int recorded = chains_.front().recorded;
    const int left_out = recorded / 5;
    result_.length = recorded - left_out;
    result_.z.resize(body_.dim(), result_.count());
    for (int c = 0; c < result_.chains; ++c) {
      result_.z.middleCols(c * result_.length, result_.length) =
          chains_[static_cast<std::size_t>(c)].z.middleCols(left_out, result_.length);
    }
  }

  Convergence assess(const ChainAssessor& assessor, int k) const {
    if (k < body_.frame.rows() && body_.frame.row(k).norm() < tolerance::kConstantRow) return {};
    const Eigen::VectorXd values = component_of(body_, result_, k).value();
    return assessor.assess({values.data(), static_cast<std::size_t>(values.size())});
  }

  /// The smallest of both effective sizes, 0 while some R̂ is too large. Stops at the first quantity that is
  /// not good enough, and begins with it the next time.
  double smallest_effective_size_so_far() {
    const ChainAssessor assessor(result_.chains, result_.length);
    const int count = static_cast<int>(body_.frame.rows()) + 1;
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count; ++i) {
      const int k = (doubted_ + i) % count;
      const Convergence c = assess(assessor, k);
      if (std::isnan(c.bulk)) continue;
      smallest = std::min({smallest, c.bulk, c.tail});
      last_reached_ = smallest;
      if (c.reached(options_.largest_rhat, options_.effective)) continue;
      doubted_ = k;
      return c.rhat <= options_.largest_rhat ? smallest : 0;
    }
    return smallest;
  }

  void finish() {
    const ChainAssessor assessor(result_.chains, result_.length);
    const int norm = static_cast<int>(body_.frame.rows());
    std::vector<Convergence> all(static_cast<std::size_t>(norm) + 1);
    team_.run(norm + 1, [&](int, std::int64_t k) {
      all[static_cast<std::size_t>(k)] = assess(assessor, static_cast<int>(k));
    });
    result_.rhat = 0;
    result_.bulk = result_.tail = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= norm; ++k) {
      const Convergence& c = all[static_cast<std::size_t>(k)];
      if (std::isnan(c.bulk)) continue;
      result_.rhat = std::max(result_.rhat, c.rhat);
      if (std::min(c.bulk, c.tail) < std::min(result_.bulk, result_.tail)) result_.slowest = k;
      result_.bulk = std::min(result_.bulk, c.bulk);
      result_.tail = std::min(result_.tail, c.tail);
    }
    result_.norm = all.back();
    all.pop_back();
    result_.components = std::move(all);
    result_.steps = (result_.sweeps * options_.chains + result_.rounding.sweeps) * body_.dim();
    summarise(assessor);
  }

  void summarise(const ChainAssessor& assessor) {
    const double n = result_.count();
    const Eigen::VectorXd mean = result_.z.rowwise().mean();
    const Eigen::MatrixXd centred = result_.z.colwise() - mean;
    result_.covariance = centred * centred.transpose() / n;
    result_.center = InternalForces(body_.origin + body_.frame * mean);
    result_.deviation = InternalForces(
        (body_.frame * result_.covariance).cwiseProduct(body_.frame).rowwise().sum().cwiseMax(0).cwiseSqrt());
    const Eigen::VectorXd squares = centred.colwise().squaredNorm();
    const Eigen::VectorXd distances = squares.cwiseSqrt();
    const double r = std::sqrt(squares.mean());
    result_.r = InternalForce(r);
    const double variance = (squares.array() - squares.mean()).square().mean();
    const double effective =
        assessor.effective_size({squares.data(), static_cast<std::size_t>(squares.size())});
    result_.r_error = InternalForce(std::sqrt(variance / effective) / (2 * r));
    result_.spread = InternalForce(std::sqrt((distances.array() - distances.mean()).square().mean()));
    const Eigen::VectorXd norms = component_of(body_, result_, static_cast<int>(body_.frame.rows())).value();
    result_.mean_norm = InternalForce(norms.mean());
    result_.norm_deviation = InternalForce(std::sqrt((norms.array() - norms.mean()).square().mean()));
  }

  static constexpr int kRound = 64;    ///< samples of each chain between two reports
  static constexpr int kRefresh = 64;  ///< sweeps between two computations of the slacks from scratch

  const ConvexBody& body_;
  const UniformOptions& options_;
  WorkerTeam team_;
  std::vector<Chain> chains_;
  int capacity_ = 0;
  int doubted_ = 0;
  double last_reached_ = 0;
  UniformSample result_;
};

}  // namespace

std::optional<std::string> UniformOptions::defect() const {
  if (!(effective >= 100 && effective <= 1e6))
    return fmt::format("the effective sample size must be in 100 … 1000000, but is {}", effective);
  if (!(largest_rhat > 1)) return fmt::format("the limit of R-hat must be above 1, but is {}", largest_rhat);
  if (chains < 2 || chains > 1000) return fmt::format("chains must be in 2 … 1000, but is {}", chains);
  if (limit < 1000) return fmt::format("the limit of sweeps must be at least 1000, but is {}", limit);
  return {};
}

UniformSample sample_uniformly(const ConvexBody& body, const UniformOptions& options) {
  if (const auto reason = options.defect()) throw InputError(*reason);
  return Sampler(body, options).run();
}

InternalForces component_of(const ConvexBody& body, const UniformSample& sample, int k) {
  if (k < body.frame.rows()) {
    const Eigen::VectorXd row = body.frame.row(k).transpose();
    return InternalForces((sample.z.transpose() * row).array() + body.origin[k]);
  }
  // ‖F‖² = ‖origin⊥‖² + ‖frameᵀ origin + z‖².
  const Eigen::VectorXd along = body.frame.transpose() * body.origin;
  const double across = (body.origin - body.frame * along).squaredNorm();
  return InternalForces(
      ((sample.z.colwise() + along).colwise().squaredNorm().array() + across).sqrt().transpose());
}

}  // namespace indet
