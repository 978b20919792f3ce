#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "libindet/base/doubled_sum.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet {

/// A linear functional by its coefficients on the edges x of a problem, ascending.
using Functional = std::vector<std::pair<int, double>>;
/// The same in twice the precision: each coefficient is within 16 u² of the exact one, relative to it.
using DoubledFunctional = std::vector<std::pair<int, Doubled>>;

/// The normal or the tangential force of a contact, times a sign; `first`:
/// EquilibriumProblem::first_unknowns. Nothing of a contact that is open.
Functional force_component(const EquilibriumProblem& problem, const std::vector<int>& first,
                           Eigen::Index contact, bool tangential, double sign);
DoubledFunctional doubled_component(const EquilibriumProblem& problem, const std::vector<int>& first,
                                    Eigen::Index contact, bool tangential, double sign);

/// Σ on_forces · (R_1, T_1, …, R_M, T_M).
Functional sum_of_forces(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces);
DoubledFunctional doubled_sum(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces);
/// Bound of what the roundings of sum_of_forces() change where 0 ≤ x ≤ `strength`.
double rounding_of_sum(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces,
                       const std::vector<double>& strength);

DoubledFunctional opposite(DoubledFunctional functional);

}  // namespace indet
