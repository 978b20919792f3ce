#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/exact/contact_problem.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// Spreads a motion of the equations' rows over disks, walls, the cell and bounds; largest entry 1.
void set_motion(const EquilibriumProblem& problem, const Eigen::VectorXd& rows, ForcePolytope& polytope);

/// A motion of the equations' rows (one velocity a row), on the rows of the exact problem, largest entry 1.
std::vector<double> motion_on_exact_rows(const exact::ContactProblem& exact,
                                         const EquilibriumProblem& problem, const Eigen::VectorXd& motion);

/// What is left of a contact when the edge of the given sign is closed.
ContactMode without_edge(ContactMode mode, int sign);

}  // namespace indet
