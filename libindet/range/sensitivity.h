#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/packing/force.h"
#include "libindet/range/outcome.h"

namespace indet {

/// What a sensitivity says of how far a value moves at most, to first order, when every normal turns by a
/// small angle and the packing still stands, over the largest of these angles (force per radian).
enum class SensitivityClaim : std::uint8_t {
  kNone,   ///< it is that of one state and one motion of perhaps several: the value may move further
  kBound,  ///< the value moves no further; +inf: no bound is known
  kExact   ///< the value moves no further, and along some turn as far
};

struct Sensitivity {
  double value = 0;
  SensitivityClaim claim = SensitivityClaim::kNone;
};

/// The sensitivities of all values; NaN where there is neither state nor interval.
struct Sensitivities {
  Table4<double> value;
  Table4<std::uint8_t> claim;  ///< SensitivityClaim

  /// NaN, without a claim.
  void clear(Eigen::Index contacts);
  void set(Eigen::Index contact, int column, const Sensitivity& sensitivity);
};

/// When normals turn by ε_α, the Lagrangian of a value with the multipliers y of the equations and the state
/// F changes by Σ_α ε_α v_α · (T_α n̂_α − R_α t̂_α), v_α the relative velocity of the contact in the motion y;
/// so by at most
///
///   s(y, F) = Σ_α |v_α · (T_α n̂_α − R_α t̂_α)|
///
/// times the largest |ε_α|. In the unit of F per radian. `motion`: one entry an equation, its sign does not
/// matter.
double sensitivity_to_normals(const EquilibriumProblem& problem, const Eigen::VectorXd& motion,
                              const SceneForces& forces);

/// v_α.
Vector2 relative_velocity(const EquilibriumProblem& problem, const Eigen::VectorXd& motion,
                          const Eigen::Matrix2d& compression, std::size_t contact);

}  // namespace indet
