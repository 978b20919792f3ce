#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/packing/packing.h"
#include "libsim/contact_solver.h"

namespace indet::sim {

/// Contact forces of a packing whose geometry is frozen, by Gauss–Seidel from given forces: one step of
/// contact dynamics from rest, with all gaps closed,
///
///     a = M⁻¹ (w + cF),   a_n ≥ 0 ⟂ R ≥ 0,   |T| ≤ μR, a_t opposed to T where |T| = μR,
///
/// for the accelerations a at the contacts. Where the packing can stand, a = 0 is a solution with every F of
/// its polytope; which one the iteration finds depends on where it starts, which is what perturb-and-resolve
/// uses.
struct StaticOptions {
  /// Stop once no force component changes by more than this in a sweep (internal unit of force). The
  /// imbalance that is left is larger by about a factor of 10.
  double tolerance = tolerance::kFineSweepChange;
  int max_sweeps = 200000;
};

struct StaticForces {
  Eigen::VectorXd forces;  ///< (R_1, T_1, …), in the scene's units; in the cones exactly.
  bool converged = false;
  std::int64_t sweeps = 0;
  double change = 0;    ///< Of the last sweep (mg).
  double residual = 0;  ///< Largest component of cF + w, torques divided by the radius, recomputed (mg).
};

/// Solves many times for one packing, which must outlive it. What depends on the packing alone is found once;
/// results do not depend on what was solved before.
class StaticSolver {
 public:
  /// Throws InputError if a wall is loaded.
  explicit StaticSolver(const Packing& packing);

  /// `initial`: (R_1, T_1, …) in the scene's units. Preconditions: size 2M, finite.
  StaticForces solve(const Eigen::VectorXd& initial, const StaticOptions& options = {});

 private:
  const Packing& packing_;
  ForceUnits units_;
  std::vector<SolverBody> free_bodies_;  ///< Under the external wrench alone; the last row is the walls'.
  std::vector<SolverBody> bodies_;
  std::vector<SolverContact> contacts_;
  ContactSolver solver_;
};

/// The same for one start.
StaticForces solve_statics(const Packing& packing, const Eigen::VectorXd& initial,
                           const StaticOptions& options = {});

}  // namespace indet::sim
