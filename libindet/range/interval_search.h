#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "libindet/barrier/lock_step.h"
#include "libindet/base/constants.h"
#include "libindet/base/progress.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/polytope/central_polytope.h"

namespace indet {

struct IntervalOptions {
  /// A value is to be known to an interval of this width, relative to max(1 mg, |value|).
  double gap = 1e-6;
  int threads = 1;  ///< the results do not depend on it
  /// Called on the calling thread now and then; false stops the search (Interrupted).
  StageProgress progress;
};

/// Those of a stage of a longer run, which is told of it by its name.
IntervalOptions interval_options(double gap, int threads, const ProgressCallback& progress,
                                 const char* stage);

/// What is known of a least value, in the unit of the problem.
struct ValueInterval {
  double lower = -kInfinity, upper = kInfinity;  ///< rigorous; infinite where nothing is proven
  double sensitivity = kNaN;                     ///< sensitivity_to_normals, in the scene's unit of force
  int iterations = 0;
  std::vector<double> x, y;  ///< that prove `upper` and `lower`, where asked for; x: one a column, y: a row

  /// What is known from both together.
  void meet(const ValueInterval& other);
};
/// No wider than `gap` times max(1 mg, |value|).
bool is_narrow(const ValueInterval& interval, const EquilibriumProblem& problem, double gap);

/// Encloses the least values of objectives on the edges' strengths, by the barrier method: every interval is
/// proven (barrier::VerifiedEquations), whatever the iteration did. One that comes out wider than asked for
/// is searched again with more care, twice at most. `central`: of the problem, perhaps within a limit.
/// `equations`: of the same problem, and within a limit if that is. `keeps_proof`: one an objective, or none
/// for no x and y.
std::vector<ValueInterval> enclose_least_values(const EquilibriumProblem& problem,
                                                const CentralPolytope& central,
                                                const barrier::VerifiedEquations& equations,
                                                std::span<const barrier::Objective> objectives,
                                                const IntervalOptions& options,
                                                const std::vector<bool>& keeps_proof = {});

}  // namespace indet
