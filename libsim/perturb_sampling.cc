#include "libsim/perturb_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/base/worker_team.h"
#include "libsim/unsupported.h"

namespace indet::sim {
namespace {

/// Samples of each chain between two reports of progress.
constexpr int kRounds = 4;

Eigen::VectorXd perturbed(const Eigen::VectorXd& forces, double width, Random& random) {
  Eigen::VectorXd result = forces;
  for (Eigen::Index i = 0; i + 1 < result.size(); i += 2) {
    const double factor = random.uniform(1 - width, 1 + width);
    result[i] *= factor;
    result[i + 1] *= factor;
  }
  return result;
}

/// Sweeps after which a solution is polished for the first time; each further time they are twice as many. To
/// polish more often saves no time.
constexpr std::int64_t kFirstSweeps = 500;

/// What the samples of one packing share; one for each worker.
struct Solvers {
  explicit Solvers(const Packing& packing, const PerturbOptions& options)
      : statics(packing), polisher(packing, options.polish) {}

  StaticSolver statics;
  Polisher polisher;
};

PerturbSample draw(Solvers& solvers, double unit, const Eigen::VectorXd& from, int index,
                   const PerturbOptions& options) {
  Random random(options.seed, static_cast<std::uint64_t>(index));
  const std::int64_t limit = options.solver.max_sweeps;
  const double reach = options.distance * unit;
  StaticForces solved{.forces = perturbed(from, options.width, random)};
  Polished polished;
  PerturbSample sample;
  StaticOptions part = options.solver;
  for (std::int64_t total = kFirstSweeps; sample.sweeps < limit && !sample.converged; total *= 2) {
    part.max_sweeps = static_cast<int>(std::min(total, limit) - sample.sweeps);
    solved = solvers.statics.solve(solved.forces, part);
    sample.sweeps += solved.sweeps;
    // The last state is polished however far balanced forces are.
    const bool last = solved.converged || sample.sweeps >= limit;
    if (!last && solvers.polisher.least_distance(solved.forces) > reach) continue;
    polished = solvers.polisher.polish(solved.forces);
    const bool close = polished.balanced && polished.distance <= reach;
    sample.converged = close || solved.converged;
  }
  sample.forces = polished.forces;
  sample.raw_residual = solved.residual;
  sample.residual = polished.residual;
  sample.cone_violation = polished.cone_violation;
  sample.accepted = std::max(sample.residual, sample.cone_violation) <= options.accept_residual * unit;
  return sample;
}

void summarise(const Packing& packing, PerturbEnsemble& ensemble) {
  const double unit = packing.force_unit();
  ensemble.center = Eigen::VectorXd::Zero(2 * packing.contact_count());
  for (const PerturbSample& sample : ensemble.samples) {
    ensemble.converged += sample.converged ? 1 : 0;
    if (!sample.accepted) continue;
    ++ensemble.accepted;
    ensemble.center += sample.forces;
    ensemble.worst_raw_residual = std::max(ensemble.worst_raw_residual, sample.raw_residual);
    ensemble.worst_residual = std::max({ensemble.worst_residual, sample.residual, sample.cone_violation});
  }
  if (ensemble.accepted == 0) return;
  ensemble.center /= ensemble.accepted;
  const double n = ensemble.accepted;
  double distances = 0;
  double squares = 0;
  double fourth = 0;
  for (const PerturbSample& sample : ensemble.samples) {
    if (!sample.accepted) continue;
    const double square = (sample.forces - ensemble.center).squaredNorm() / (unit * unit);
    distances += std::sqrt(square);
    squares += square;
    fourth += square * square;
  }
  ensemble.r = std::sqrt(squares / n);
  const double mean = distances / n;
  ensemble.spread = std::sqrt(std::max(0.0, squares / n - mean * mean));
  const double variance = std::max(0.0, fourth / n - squares / n * (squares / n));
  ensemble.r_error = ensemble.r > 0 ? std::sqrt(variance / n) / (2 * ensemble.r) : 0;
  ensemble.start_distance = (packing.simulated_forces().value() - ensemble.center).norm() / unit;
}

}  // namespace

std::optional<std::string> PerturbOptions::defect() const {
  if (samples < 1) return fmt::format("samples must be at least 1, but is {}", samples);
  if (chains < 1 || chains > samples)
    return fmt::format("chains must be in 1 … {}, but is {}", samples, chains);
  if (!(width > 0 && width <= 1)) return fmt::format("the width must be in (0, 1], but is {}", width);
  if (!(distance >= 0)) return "the distance must not be negative";
  if (!(solver.tolerance >= 0)) return "the tolerance must not be negative";
  if (solver.max_sweeps < 1) return "sweeps must be at least 1";
  return {};
}

PerturbEnsemble perturb_and_resolve(const Packing& packing, const PerturbOptions& options,
                                    const ProgressCallback& progress) {
  if (const auto reason = options.defect()) throw InputError(*reason);
  if (!packing.has_simulated_forces()) {
    throw InputError("the packing's forces are unknown, but perturb-and-resolve starts from them");
  }
  refuse_unsupported(packing, "perturb-and-resolve");
  PerturbEnsemble ensemble;
  ensemble.samples.resize(static_cast<std::size_t>(options.samples));
  // Sample i belongs to chain i mod chains. Chains advance together, one round of samples at a time.
  const int chains = options.chains;
  std::vector<Eigen::VectorXd> ends(static_cast<std::size_t>(chains), packing.simulated_forces().value());
  const double unit = packing.force_units().internal_in_weights();
  WorkerTeam team(std::clamp(options.threads, 1, chains));
  std::deque<Solvers> solvers;  // They cannot move, as a vector would have them do.
  for (int worker = 0; worker < team.workers(); ++worker) solvers.emplace_back(packing, options);
  for (int begin = 0; begin < options.samples; begin += kRounds * chains) {
    const int end = std::min(options.samples, begin + kRounds * chains);
    team.run(chains, [&](int worker, std::int64_t chain) {
      Eigen::VectorXd& from = ends[static_cast<std::size_t>(chain)];
      for (int i = begin + static_cast<int>(chain); i < end; i += chains) {
        PerturbSample& sample = ensemble.samples[static_cast<std::size_t>(i)];
        sample = draw(solvers[static_cast<std::size_t>(worker)], unit, from, i, options);
        if (sample.accepted) from = sample.forces;
      }
    });
    const double residual = ensemble.samples[static_cast<std::size_t>(end - 1)].raw_residual;
    if (progress &&
        !progress({"perturb and resolve", end, options.samples, fmt::format("residual {:.1e}", residual)})) {
      throw Interrupted();
    }
  }
  summarise(packing, ensemble);
  return ensemble;
}

}  // namespace indet::sim
