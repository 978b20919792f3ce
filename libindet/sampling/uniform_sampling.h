#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/coordinate_walk.h"
#include "libindet/sampling/rounding.h"
#include "libindet/statistics/convergence.h"

namespace indet {

/// Uniform sampling of a body by coordinate hit-and-run with rounding (CHRR: H. S. Haraldsdóttir, B. Cousins,
/// I. Thiele, R. M. T. Fleming and S. Vempala, Bioinformatics 33, 1741 (2017)), until several chains from
/// dispersed starts agree about every component of F and about its norm (docs/sampling.md).
struct UniformOptions {
  double effective = 400;  ///< smallest bulk and tail effective sample size of every quantity, ≥ 100
  double largest_rhat = 1.01;
  int chains = 4;  ///< ≥ 2
  std::uint64_t seed = 0;
  std::int64_t limit = 1000000;  ///< most sweeps of a chain after the warm-up, ≥ 1000
  int threads = 1;               ///< the result does not depend on it
  ProgressCallback progress;

  std::optional<std::string> defect() const;
};

/// What was drawn.
struct UniformSample {
  bool converged = false;      ///< false: stopped at the limit of sweeps
  int chains = 0, length = 0;  ///< samples: `chains` chains of `length` each
  std::int64_t interval = 0;   ///< sweeps between samples
  std::int64_t sweeps = 0;     ///< of each chain, its first fifth included, which is left out
  std::int64_t steps = 0;      ///< coordinate steps of all chains, warm-up included
  RoundingResult rounding;
  InscribedBall ball;
  Eigen::MatrixXd z;       ///< n × (chains · length), chain after chain
  double worst_slack = 0;  ///< least slack of all samples, each recomputed from its z

  std::vector<Convergence> components;  ///< of F; NaN where it is determined
  Convergence norm;                     ///< of ‖F‖
  double rhat = 0;                      ///< the largest
  double bulk = 0, tail = 0;            ///< the smallest
  int slowest = -1;                     ///< component of the smallest effective size; its number 2M: ‖F‖

  InternalForces center;       ///< F°, the mean
  InternalForces deviation;    ///< standard deviation of each component
  Eigen::MatrixXd covariance;  ///< n × n, of z; that of F is frame · covariance · frameᵀ
  InternalForce r{-1};         ///< (mean ‖F − F°‖²)^½ [38]
  InternalForce r_error{-1};   ///< its standard error, from the effective size of ‖F − F°‖²
  InternalForce spread{-1};    ///< standard deviation of ‖F − F°‖
  InternalForce mean_norm{-1}, norm_deviation{-1};  ///< of ‖F‖
  double seconds = 0;                               ///< elapsed, warm-up included
  double core_seconds = 0;                          ///< processor time of the whole process meanwhile

  int count() const { return chains * length; }
};

/// Preconditions: the body is bounded and has an interior. Throws InputError with the options' defect,
/// Interrupted, and LibraryError if a sample violates an inequality by more than tolerance::kSampleResidual.
UniformSample sample_uniformly(const ConvexBody& body, const UniformOptions& options);

/// Component k of F over the samples, chain after chain; k = 2M: ‖F‖.
InternalForces component_of(const ConvexBody& body, const UniformSample& sample, int k);

}  // namespace indet
