#pragma once

#include <span>
#include <vector>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_structure.h"
#include "libindet/barrier/lock_step.h"
#include "libindet/barrier/verified_equations.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// Pairs x, x' of {A x = b, x ≥ 0} of which c·x, c·x' are the least and the largest, and the contact forces B
/// x, B x' as near to each other as they can be: minimise
///
///   c·x − c·x' + ‖B (x − x')‖² / 2g                                                              (P)
///
/// For g beyond some value the solution is of that kind, exactly: what a pair gains in distance away from the
/// two faces where c·x is least and largest is less than what it loses in c·x (Mangasarian and Meyer, SIAM J.
/// Control Optim. 17, 745 (1979)).
///
/// Whatever g is, and x, x' and multipliers y, y', z are, weak duality bounds (P) from below by
///
///   D = b·y + b·y' − g ‖z‖²/2 + Σ min(0, h_k) X_k + Σ min(0, h'_k) X_k,
///   h = c − Aᵀy − Bᵀz,   h' = −c − Aᵀy' + Bᵀz
///
/// so that the pairs on the faces have ‖B (x − x')‖² ≥ 2g (D + largest c·x − least c·x).
class StatePairs {
 public:
  /// `rows`, `centre`, `equations`: as of a CentralPolytope, which has to outlive this, as has `problem`.
  StatePairs(const EquilibriumProblem& problem, std::span<const int> rows, const BlockStructure& single,
             const AnalyticCentre& centre, const VerifiedEquations& equations);

  /// Of both copies in one, for minimise_in_lock_step, and where that starts.
  const BlockStructure& structure() const { return structure_; }
  const AnalyticCentre& centre() const { return centre_; }
  /// The linear part of (P).
  Objective objective(const Objective& c) const;

  /// What an iterate proves, in the unit of the problem.
  struct Proof {
    double distance = 0;  ///< some states x, x' have ‖B (x − x')‖ up to this,
    double least = 0;     ///< c·x up to this,
    double largest = 0;   ///< and c·x' at least this
    double dual = 0;      ///< D
  };
  Proof prove(const Objective& c, double g, const Iterate& iterate) const;

 private:
  const EquilibriumProblem& problem_;
  const BlockStructure& single_;
  const AnalyticCentre& single_centre_;
  const VerifiedEquations& equations_;
  BlockStructure structure_;
  AnalyticCentre centre_;
};

}  // namespace indet::barrier
