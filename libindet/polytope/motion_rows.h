#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "libindet/barrier/block_structure.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/exact/contact_problem.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// Multipliers of a structure's rows, in its order, as a motion of all equations: 0 in those that it leaves
/// out. That of a limit is dropped.
Eigen::VectorXd on_equations(const EquilibriumProblem& problem, const barrier::BlockStructure& structure,
                             std::span<const double> y);

/// Stores a motion of the exact problem's rows, on disks, walls, the cell and bounds, as the one of the
/// polytope.
void set_motion(const Packing& packing, const exact::ContactProblem& exact, std::span<const double> rows,
                ForcePolytope& polytope);

/// What a velocity of this row is multiplied by in the exact problem's row of the same body and component.
double exact_row_scale(const exact::ContactProblem& exact, const EquilibriumRow& row);

/// A motion of the equations' rows (one velocity a row), on the rows of the exact problem, largest entry 1.
std::vector<double> motion_on_exact_rows(const exact::ContactProblem& exact,
                                         const EquilibriumProblem& problem, const Eigen::VectorXd& motion);

/// What is left of a contact when the edge of the given sign is closed.
ContactMode without_edge(ContactMode mode, int sign);

}  // namespace indet
