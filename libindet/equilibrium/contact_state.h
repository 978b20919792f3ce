#pragma once

#include <Eigen/Core>

#include "libindet/packing/force_bounds.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The residual of equilibrium of each disk, computed contact by contact from the packing (not from a
/// matrix): force x, force y, torque/r in mg, a row a disk; 0 for fixed disks. `forces`: 2M.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> equilibrium_residual(const Packing& packing,
                                                                               const SceneForces& forces);

/// The same of each wall along its normal and tangent, [W, 2]: load − ΣR, load − ΣT; 0 where it is not free.
Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> wall_residual(const Packing& packing,
                                                                        const SceneForces& forces);

/// The stress that contact forces make in a full cell, Σ f_i l_j / A: row i, column j.
Eigen::Matrix2d contact_stress(const Packing& packing, const SceneForces& forces);

/// The residual of the imposed components of the stress (xx, yy, xy, pressure), as forces across a side of
/// the cell in mg: (A σ_ij − Σ f_i l_j)/L with L = Packing::cell_length; 0 of what is not imposed.
Eigen::Vector4d stress_residual(const Packing& packing, const SceneForces& forces);

/// The largest of all three, by magnitude; 0 for a packing without bodies.
double largest_imbalance(const Packing& packing, const SceneForces& forces);

/// The largest amount by which forces break one of the bounds (force_bounds.h), in the scene's unit; 0 if
/// none.
double worst_bound_violation(const std::vector<ForceBound>& bounds, const SceneForces& forces);

/// How a contact state stands to the Coulomb conditions [16], with tolerance ε (in the internal unit of
/// force, which is mg unless the scene names a unit that says little about it). Of an unknown force (NaN) no
/// condition tells; R < 0 does without T.
struct CoulombCount {
  int sliding = 0;             ///< μR − |T| < ε, counting a non-transmitting contact twice (Sec. II E)
  int non_transmitting = 0;    ///< R, |T| < ε
  int violated = 0;            ///< R < −ε or |T| > μR + ε
  double worst_violation = 0;  ///< largest of −R and |T| − μR, mg; 0 if none
};
CoulombCount count_coulomb(const Packing& packing, const SceneForces& forces, double epsilon);

}  // namespace indet
