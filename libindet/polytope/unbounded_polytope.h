#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/polytope/central_polytope.h"

namespace indet {

/// What the barrier method works on where F = {A x = b, x ≥ 0} is unbounded. The *unlimited* edges are those
/// that some ray loads; one ray r of maximal support loads them all.
///
///   cone    {A r = 0, Σr ≤ n} on the n unlimited edges: what decreases there decreases without limit in F
///   within  F ∩ {Σ over the unlimited edges ≤ total}, which has a centre
///
/// A narrow limit serves proofs, whose room for rounding grows with the strengths at the centre; a wide one
/// searches, for what is least over F may be least where strengths are large.
///
/// A ray leaves the bodies whose equations no unlimited edge enters alone. If the equations of the others are
/// independent on the unlimited edges, as the proof of the cone's centre shows, near every point of the cone
/// there is an exact ray.
struct UnboundedPolytope {
  UnboundedPolytope(EquilibriumProblem of_cone, std::span<const int> rows_of_cone);
  UnboundedPolytope(const UnboundedPolytope&) = delete;
  UnboundedPolytope& operator=(const UnboundedPolytope&) = delete;

  EquilibriumProblem cone_problem;  ///< with the unlimited edges alone, without load
  CentralPolytope cone;
  std::vector<int> unlimited;  ///< of each edge of the cone: that of the whole problem; ascending
  std::vector<int> rows;       ///< of the whole problem: independent, the others follow
  double total = 0;            ///< Σ over the unlimited edges at some state
  /// Limited to few times that, for proofs.
  std::shared_ptr<const CentralPolytope> within;
};

/// `rows`: independent equations that the others follow from; `state`: x > 0 with A x = b; `ray`: of maximal
/// support, exactly 0 on limited edges. Nothing if the centre of the cone or that of F within a limit is not
/// proven.
std::shared_ptr<const UnboundedPolytope> find_unbounded_polytope(const EquilibriumProblem& problem,
                                                                 std::span<const int> rows,
                                                                 std::span<const double> state,
                                                                 const Eigen::VectorXd& ray);

/// The part of F within `factor` times the total. It need not be proven.
std::shared_ptr<const CentralPolytope> limited_polytope(const EquilibriumProblem& problem,
                                                        const UnboundedPolytope& polytope, double factor);

}  // namespace indet
