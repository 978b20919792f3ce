/// Effective samples a second of four random walks over the same polytope, one core, in one run:
/// coordinate hit-and-run and hit-and-run along random directions, each in rounded coordinates and in the
/// coordinates as they are.
///
/// usage: bench_walks PACKING.h5 [seconds for each walk]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/io/packing_file.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet {
namespace {

constexpr int kChains = 4;
constexpr int kLength = 2000;

/// Hit-and-run along random directions (R. L. Smith, Oper. Res. 32, 1296 (1984)), whose step costs O(K n).
class DirectionWalk {
 public:
  DirectionWalk(const RoundedBody& body, Eigen::VectorXd y, Random random)
      : body_(&body), y_(std::move(y)), random_(random) {}

  void step() {
    Eigen::VectorXd direction(y_.size());
    for (double& component : direction) component = random_.normal();
    const Eigen::ArrayXd rates = body_->slope * direction;
    const Eigen::ArrayXd slacks = (body_->offset + body_->slope * y_).cwiseMax(1e-250);
    const Eigen::ArrayXd quotients = rates / slacks;
    y_ += random_.uniform(-1 / quotients.maxCoeff(), -1 / quotients.minCoeff()) * direction;
  }
  const Eigen::VectorXd& position() const { return y_; }

 private:
  const RoundedBody* body_;
  Eigen::VectorXd y_;
  Random random_;
};

/// Lets four chains move for some seconds, and judges them by every component of F.
void measure(const std::string& name, const ConvexBody& body, const Rounding& rounding, double warm_up,
             double seconds, const std::vector<std::function<const Eigen::VectorXd&()>>& move) {
  UniformSample sample;
  sample.chains = kChains;
  std::vector<Eigen::MatrixXd> z(kChains, Eigen::MatrixXd(body.dim(), kLength));
  int recorded = 0;
  std::int64_t interval = 1;
  std::int64_t sweeps = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  while (elapsed() < seconds) {
    if (recorded == kLength) {
      for (Eigen::MatrixXd& chain : z) {
        for (int i = 0; 2 * i + 1 < kLength; ++i) chain.col(i) = chain.col(2 * i + 1).eval();
      }
      recorded /= 2;
      interval *= 2;
    }
    for (std::size_t c = 0; c < kChains; ++c) {
      const Eigen::VectorXd* y = nullptr;
      for (std::int64_t i = 0; i < interval; ++i) y = &move[c]();
      z[c].col(recorded) = rounding.center + rounding.transform * *y;
    }
    ++recorded;
    sweeps += interval;
  }
  const double walked = elapsed();
  const int left_out = recorded / 5;
  sample.length = recorded - left_out;
  sample.z.resize(body.dim(), sample.count());
  for (int c = 0; c < kChains; ++c) {
    sample.z.middleCols(c * sample.length, sample.length) =
        z[static_cast<std::size_t>(c)].middleCols(left_out, sample.length);
  }
  const ChainAssessor assessor(kChains, sample.length);
  double rhat = 0;
  double effective = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= body.frame.rows(); ++k) {
    if (k < body.frame.rows() && body.frame.row(k).norm() < 1e-12) continue;
    const Eigen::VectorXd values = component_of(body, sample, k).value();
    const Convergence c = assessor.assess({values.data(), static_cast<std::size_t>(values.size())});
    if (std::isnan(c.bulk)) continue;
    rhat = std::max(rhat, c.rhat);
    effective = std::min({effective, c.bulk, c.tail});
  }
  fmt::print("| {} | {:.0f} | {:.3f} | {:.0f} | {:.2f} | {:.2g} |\n", name,
             static_cast<double>(sweeps * kChains) / walked, rhat, effective, effective / walked, warm_up);
}

void compare(const std::string& file, double seconds) {
  const ForcePolytope polytope = find_force_polytope(read_packing(file));
  if (polytope.status != PolytopeStatus::kBounded)
    throw InputError("the polytope is not bounded, or a point");
  const ConvexBody body = make_body(polytope);
  const auto begin = std::chrono::steady_clock::now();
  const InscribedBall ball = find_inscribed_ball(body);
  WorkerTeam team(1);
  const Rounding rounding_found = round_body(body, ball.center, {}, team).rounding;
  const double warm_up = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Rounding plain{ball.center, Eigen::MatrixXd::Identity(body.dim(), body.dim())};
  const Eigen::MatrixXd starts = dispersed_points(body, ball.center, kChains, 0);

  fmt::print("{}: dimension {}, {} half-planes, {} s for each walk\n\n", file, body.dim(),
             body.view.inequalities(), seconds);
  fmt::print("| walk | sweeps of n steps a second | R-hat | effective samples | a second | warm-up (s) |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const auto& [rounding, how] :
       {std::pair{rounding_found, "rounded"}, std::pair{plain, "as they are"}}) {
    const RoundedBody rounded(body, rounding);
    std::vector<CoordinateWalk> along_axes;
    std::vector<DirectionWalk> along_directions;
    std::vector<std::function<const Eigen::VectorXd&()>> axes, directions;
    for (int c = 0; c < kChains; ++c) {
      const Eigen::VectorXd y =
          rounding.transform.triangularView<Eigen::Lower>().solve(starts.col(c) - rounding.center);
      along_axes.emplace_back(rounded, y, Random(1, static_cast<std::uint64_t>(c)));
      along_directions.emplace_back(rounded, y, Random(2, static_cast<std::uint64_t>(c)));
    }
    for (std::size_t c = 0; c < kChains; ++c) {
      axes.emplace_back([&along_axes, c]() -> const Eigen::VectorXd& {
        along_axes[c].sweep();
        return along_axes[c].position();
      });
      directions.emplace_back([&along_directions, c, n = body.dim()]() -> const Eigen::VectorXd& {
        for (int i = 0; i < n; ++i) along_directions[c].step();
        return along_directions[c].position();
      });
    }
    const double spent = rounding.transform == plain.transform ? 0 : warm_up;
    measure(fmt::format("coordinates, {}", how), body, rounding, spent, seconds, axes);
    measure(fmt::format("directions, {}", how), body, rounding, spent, seconds, directions);
  }
}

}  // namespace
}  // namespace indet

int main(int count, char** arguments) {
  if (count < 2) {
    fmt::print(stderr, "usage: bench_walks PACKING.h5 [seconds for each walk]\n");
    return 2;
  }
  try {
    indet::compare(arguments[1], count > 2 ? std::atof(arguments[2]) : 10);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
