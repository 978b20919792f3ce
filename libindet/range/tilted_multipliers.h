#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "libindet/range/basis_system.h"
#include "libindet/range/doubled_equations.h"

namespace indet {

/// Multipliers y' near y with h_k = (g − Aᵀ y')_k ≤ 0, proven, on all edges with `strength` X_k = ∞: those
/// that some ray of an unbounded F loads, where h_k > 0 proves nothing. With y from the basis (B, N),
///
///   y' = y + ε t,   Aᵀ t = 1 on the edges of B that the motion y moves
///
/// takes ε from what rounding leaves of h on these, and harms no edge of N with reduced costs above rounding.
/// Bodies that y does not move stay at rest, exactly, and with them all edges between them: so are those of a
/// ray that does not change g·x. Nothing if no ε will do. With y', g − Aᵀ y'.
std::optional<BasisSystem::Solution> tilted_multipliers(const DoubledEquations& equations,
                                                        const BasisSystem& system, const DoubledFunctional& g,
                                                        std::span<const Doubled> y,
                                                        const Eigen::VectorXd& strength);

}  // namespace indet
