#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "libindet/barrier/lock_step.h"
#include "libindet/polytope/unbounded_polytope.h"
#include "libindet/range/interval_search.h"

namespace indet {

/// Which objectives have no least value over an unbounded polytope.
struct Growth {
  std::vector<Eigen::VectorXd> rays;  ///< strengths of the edges of the whole problem, largest 1
  std::vector<int> ray;  ///< of each objective: the ray along which it falls; −1: none was found
  std::int64_t searches = 0, iterations = 0;
};

/// An objective c·x has no least value over F if it falls along some ray. One ray tells of many objectives:
/// at first the centre of the recession cone, then the rays along which the sum of all objectives that are
/// left falls most steeply, then those of one objective after the other, by the barrier method on the cone.
/// What is told of a ray is proven (barrier::VerifiedEquations): an exact one is so near that the objective
/// falls along it, too. That there is none is not. Objectives are on the edges of the whole problem. Throws
/// Interrupted.
Growth find_growth(const UnboundedPolytope& polytope, const EquilibriumProblem& problem,
                   std::span<const barrier::Objective> objectives, const IntervalOptions& options);

}  // namespace indet
