#pragma once

#include <string>

#include "libindet/io/imported_packing.h"

namespace indet {

/// How well the forces of an imported packing hold it in equilibrium. Residuals are in the packing's unit of
/// force (mg), those of torque divided by the radius of the disk. Where only a part of the forces is known,
/// they are those of the disks all of whose forces are known, and the Coulomb conditions are those that known
/// forces tell of.
struct BalanceReport {
  bool forces_known = false;  ///< R and T of every contact.
  int known_forces = 0;       ///< How many R and T are known, of 2M.
  int checked_disks = 0;      ///< Disks that the residuals are of. Without any they are 0.
  double force_residual = 0;  ///< Largest magnitude of the net force on a free disk.
  DiskId worst_force;
  double torque_residual = 0;  ///< Largest magnitude of the net torque on a free disk.
  DiskId worst_torque;
  double wall_residual = 0;  ///< Largest net force on a loaded wall, where it is free.
  WallId worst_wall;
  double stress_residual = 0;  ///< Largest of stress_residual (contact_state.h), if all forces are known.
  int coulomb_violations = 0;  ///< Contacts with R < −ε or |T| > μR + ε, ε = tolerance::kSliding.
  double worst_violation = 0;  ///< Largest of −R and |T| − μR.
  int sliding = 0;             ///< Non-transmitting contacts count twice.
  int non_transmitting = 0;    ///< R and |T| below ε.
  int duplicates = 0;          ///< Contacts given twice with equal forces, and taken once.
  int loose_disks = 0;         ///< Free disks without contacts.
  DiskId first_loose;          ///< The first of them.

  bool any_known() const { return forces_known || known_forces > 0; }
};

BalanceReport report_balance(const ImportedPacking& imported);

/// The residual (mg) up to which an import is accepted unless the user says otherwise: tolerance::kBalance of
/// the internal unit, so that no unit that the scene names decides what is accepted; or what the rounding of
/// a file with few digits explains.
double default_balance_tolerance(const ImportedPacking& imported);

/// Throws InputError if a residual is above `tolerance` (mg), with the causes that it may have and what each
/// would leave (imbalance.h). Disks of which some force is unknown pass.
void require_balance(const ImportedPacking& imported, const BalanceReport& report, double tolerance);

}  // namespace indet
