#pragma once

#include <string>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/packing/packing.h"
#include "libsim/balance_solver.h"

namespace indet::sim {

/// Turns forces that nearly balance into forces that balance to rounding, changing them as little as
/// possible:
///
///     minimise ‖F − F_raw‖²  subject to  cF = −w,  F in the friction cones,
///
/// where contacts that slide in the raw state (|T| = μR) stay sliding: T = ±μR, one unknown instead of two.
/// The equality-constrained problem is that of balance_solver.h; cone conditions that the solution violates
/// join an active set (contact opened: R = T = 0; or sliding) until none is violated. Forces are in the
/// internal unit of the packing throughout, torques are divided by the disk's radius.
///
/// It stands in for the last decades of a Gauss–Seidel iteration, which needs 1e4–1e5 sweeps for them.
struct PolishOptions {
  /// A raw contact slides if μR − |T| ≤ sliding · max(R, 1). Gauss–Seidel puts sliding contacts on the limit
  /// exactly; springs leave the rounding of their stretch.
  double sliding = tolerance::kPolishSliding;
  /// A contact transmits force if R > transmitting (internal unit); the others leave the packing.
  double transmitting = tolerance::kPolishTransmitting;
  int max_rounds = 50;                           ///< Of the active set.
  double residual = tolerance::kPolishResidual;  ///< Balanced means at most this (internal unit).
};

struct Polished {
  bool balanced = false;
  std::string reason;  ///< Why it is not balanced.
  Eigen::VectorXd
      forces;  ///< (R_1, T_1, …), one pair for each contact of the input; 0 where opened. Scene's units.
  double residual = -1;        ///< Largest component of cF + w, recomputed from the contacts (mg).
  double cone_violation = -1;  ///< Largest of −R and |T| − μR (mg), ≥ 0.
  double distance =
      -1;  ///< ‖F − F_raw‖ (mg): an upper bound of the distance from the raw state to the polytope.
  bool sliding_kept = true;  ///< False if raw sliding contacts had to be let stick to find a balance.
  int sliding = 0;           ///< Contacts held at the Coulomb limit.
  int opened = 0;            ///< Contacts found to transmit nothing.
  int rounds = 0;
};

/// Polishes many raw states of one packing, which must outlive it. What depends on the packing alone is found
/// once; results do not depend on what was polished before.
class Polisher {
 public:
  /// Throws InputError if a wall is loaded.
  explicit Polisher(const Packing& packing, const PolishOptions& options = {});

  /// `raw`: (R_1, T_1, …) of the packing's contacts in the scene's units. Precondition: size 2M, finite.
  Polished polish(const Eigen::VectorXd& raw);

  /// A lower bound of the distance (mg) of what `polish` would find, at a fraction of its time: the least
  /// change that balances the disks if there were no cones. The same precondition.
  double least_distance(const Eigen::VectorXd& raw);

 private:
  /// One run of the active set.
  struct Attempt {
    std::vector<ContactStatus> statuses;
    Eigen::VectorXd forces;  ///< Internal unit.
    int rounds = 0;
    bool settled = false;
    double residual = 0;
  };
  Attempt attempt(std::vector<ContactStatus> statuses);

  const Packing& packing_;
  PolishOptions options_;
  ForceUnits units_;
  BalanceSolver solver_;
  Eigen::VectorXd raw_;  ///< Internal unit.
};

/// The same for one raw state.
Polished polish(const Packing& packing, const Eigen::VectorXd& raw, const PolishOptions& options = {});

/// Largest component of cF + w in units of force, torques divided by the radius.
double balance_residual(const Packing& packing, const Eigen::VectorXd& forces);

/// Largest of −R and |T| − μR over all contacts, in units of force; 0 if F is in the cones.
double cone_violation(const Packing& packing, const Eigen::VectorXd& forces);

}  // namespace indet::sim
