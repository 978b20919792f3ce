#pragma once

#include <vector>

#include "libindet/barrier/verified_equations.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/barrier_ranges.h"
#include "libindet/range/central_widths.h"
#include "libindet/range/interval_search.h"

namespace indet {

/// Whether a width says that its force is the same in every state: it is within rounding of 0, relative to
/// the normal force at the centre, or to μ times that.
bool is_determined(const Packing& packing, const CentralWidths& widths, Eigen::Index contact,
                   bool tangential);

/// Proofs for forces that are determined by their widths, without a search: duality with the nearest
/// multipliers (barrier::VerifiedEquations::enclose_everywhere) leaves but rounding between their minimum and
/// their maximum.
class DeterminedForces {
 public:
  /// Both must outlive this. `central`: of the problem, perhaps within a limit.
  DeterminedForces(const EquilibriumProblem& problem, const CentralPolytope& central);

  /// The least value of the objective, and −1 times that of the opposite one; x is near the centre, y the
  /// nearest multipliers.
  ValueInterval enclose(const barrier::Objective& objective) const;
  /// Whether it is so narrow, and no wider than `gap` allows, that the width was right.
  bool is_proof(const ValueInterval& interval, double gap) const;

 private:
  const EquilibriumProblem& problem_;
  const CentralPolytope& central_;
  std::vector<double> centre_;
  SceneForces forces_;  ///< at the centre
};

/// Encloses the forces of all contacts that were not searched for and that are determined by their widths:
/// minimum and maximum get one interval, and so δ = 0. Where that is no proof the width was mistaken, and the
/// outcome is kFailed. Forces of contacts whose edges are all closed are 0. No objective is searched for.
/// `options`: gap and progress. Throws Interrupted. Precondition: polytope.central.
void enclose_determined(const Packing& packing, const ForcePolytope& polytope, const CentralWidths& widths,
                        const IntervalOptions& options, BarrierRanges& ranges);

}  // namespace indet
