#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/base/worker_team.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/coordinate_walk.h"

namespace indet {

/// Rounding by iterated covariance. The first coordinates are those of the Dikin ellipsoid at the analytic
/// centre; then, in turn, chains walk, the covariance of where they were (by block) becomes the new unit
/// ellipsoid, and the walks become longer, until the covariance changes no direction by more than
/// `settled`. In the coordinates that result the covariance of the uniform distribution is about 1. Any
/// rounding gives the right distribution; a good one gives it sooner.
struct RoundingOptions {
  int chains = 4;
  std::uint64_t seed = 0;
  int most_phases = 10;
  double settled = 2;  ///< ratio of the largest to the smallest standard deviation
};

struct RoundingResult {
  Rounding rounding;
  int phases = 0;
  std::int64_t sweeps = 0;  ///< of all chains
  double ratio = 0;         ///< of the last phase, see `settled`
};

/// Precondition: `interior` is strictly inside. The result does not depend on the number of workers.
RoundingResult round_body(const ConvexBody& body, const Eigen::VectorXd& interior,
                          const RoundingOptions& options, WorkerTeam& team);

/// Points for chains to start from, far from each other: nine tenths of the way from `interior` to vertices
/// that are found by walking in random directions. A column a point.
Eigen::MatrixXd dispersed_points(const ConvexBody& body, const Eigen::VectorXd& interior, int count,
                                 std::uint64_t seed);

}  // namespace indet
