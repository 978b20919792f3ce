#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/lp/vertex.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// Splits a full-dimensional polytope into its independent blocks.
///
/// With the active inequalities N of a vertex as coordinates, x = x_vertex + D x_N, D = S S_N⁻¹; two edges
/// are coupled when a chain of non-zeros of D, or a common contact, joins them. The result does not depend on
/// the vertex. Edges whose row of D vanishes are determined and belong to no block.
std::vector<PolytopeBlock> split_into_blocks(const EquilibriumProblem& problem, const SlopeView& whole,
                                             const Vertex& vertex);

}  // namespace indet
