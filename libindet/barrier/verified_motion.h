#pragma once

#include <optional>
#include <span>
#include <vector>

#include "libindet/barrier/block_structure.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// True if Aᵀ y > 0 and b·y < 0 for certain, with A and b those of the scene, of which the ones in memory are
/// roundings with bounds entry by entry (as in verified_equations.h): then no x ≥ 0 has A x = b.
///
/// A motion rests at most contacts, so that (Aᵀ y)_k is about 0 there, and this proves nothing of it. But
/// where some y₁ has Aᵀ y₁ ≥ 1 (Boundedness::y), y + ε y₁ is no less a proof, and rests nowhere.
bool proves_emptiness(const EquilibriumProblem& problem, const BlockStructure& structure,
                      std::span<const double> y);

/// y + ε y₁ with the largest of some ε, from the rounding of Aᵀ y up, of which that holds; the largest
/// entry of y is 1. Nothing if it holds of none.
std::optional<std::vector<double>> proven_motion(const EquilibriumProblem& problem,
                                                 const BlockStructure& structure, std::span<const double> y,
                                                 std::span<const double> y_1);

}  // namespace indet::barrier
