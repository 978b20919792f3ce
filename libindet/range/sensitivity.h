#pragma once

#include <Eigen/Core>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/packing/force.h"

namespace indet {

/// How far an optimal value moves at most, to first order, when every normal turns by a small angle ε_α, over
/// the largest |ε_α|: with the multipliers y of the equations and the state F at the optimum,
///
///   Σ_α |v_α · (T_α n̂_α − R_α t̂_α)|,   v_α the relative velocity of the contact in the motion y
///
/// in the unit of F per radian. `motion`: one entry an equation, its sign does not matter.
double sensitivity_to_normals(const EquilibriumProblem& problem, const Eigen::VectorXd& motion,
                              const SceneForces& forces);

}  // namespace indet
