#include "libindet/io/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/io/imbalance.h"

namespace indet {

namespace {

/// What is known about the forces of each disk.
struct DiskKnowledge {
  std::vector<bool> held, complete;  ///< It has a contact; R and T of all its contacts are known.

  explicit DiskKnowledge(const Packing& packing)
      : held(packing.disks.size(), false), complete(packing.disks.size(), true) {
    for (const Contact& contact : packing.contacts) {
      const bool known = std::isfinite(contact.R) && std::isfinite(contact.T);
      note(contact.a, known);
      if (!contact.b.is_wall()) note(contact.b.disk_id(), known);
    }
  }

 private:
  void note(DiskId disk, bool known) {
    const auto row = static_cast<std::size_t>(disk.value());
    held[row] = true;
    if (!known) complete[row] = false;
  }
};

/// Net forces and torques of the disks whose forces are all known. A disk without contacts is one of them
/// only where all other forces are known too: a list of measured forces may lack contacts.
void report_residuals(const Packing& packing, const SceneForces& forces, const DiskKnowledge& knowledge,
                      BalanceReport& report) {
  const auto residual = equilibrium_residual(packing, forces);
  for (int i = 0; i < packing.disk_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const bool checked = report.forces_known || (knowledge.held[row] && knowledge.complete[row]);
    if (!checked || !packing.has_equations(DiskId(i))) continue;
    ++report.checked_disks;
    const double force = std::hypot(residual(i, 0), residual(i, 1));
    if (force > report.force_residual) {
      report.force_residual = force;
      report.worst_force = DiskId(i);
    }
    const double torque = std::abs(residual(i, 2));
    if (torque > report.torque_residual) {
      report.torque_residual = torque;
      report.worst_torque = DiskId(i);
    }
  }
  const auto of_walls = wall_residual(packing, forces);
  for (int w = 0; w < packing.wall_count(); ++w) {
    const double force = of_walls.row(w).norm();
    if (force > report.wall_residual) {
      report.wall_residual = force;
      report.worst_wall = WallId(w);
    }
  }
}

}  // namespace

BalanceReport report_balance(const ImportedPacking& imported) {
  const Packing& packing = imported.packing;
  const DiskKnowledge knowledge(packing);
  BalanceReport report;
  report.duplicates = imported.duplicates;
  for (std::size_t i = knowledge.held.size(); i-- > 0;) {
    if (knowledge.held[i] || packing.disks[i].fixed) continue;
    ++report.loose_disks;
    report.first_loose = DiskId(static_cast<std::int64_t>(i));
  }
  report.forces_known = packing.has_simulated_forces();
  for (const Contact& contact : packing.contacts) {
    report.known_forces += (std::isfinite(contact.R) ? 1 : 0) + (std::isfinite(contact.T) ? 1 : 0);
  }
  if (!report.any_known()) return report;

  const SceneForces forces = packing.simulated_forces();
  report_residuals(packing, forces, knowledge, report);
  if (report.forces_known && packing.stress.is_imposed())
    report.stress_residual = stress_residual(packing, forces).cwiseAbs().maxCoeff();
  const CoulombCount coulomb = count_coulomb(packing, forces, tolerance::kSliding);
  report.coulomb_violations = coulomb.violated;
  report.worst_violation = coulomb.worst_violation;
  report.sliding = coulomb.sliding;
  report.non_transmitting = coulomb.non_transmitting;
  return report;
}

double default_balance_tolerance(const ImportedPacking& imported) {
  const Packing& packing = imported.packing;
  const ForceUnits units = packing.force_units();
  const double exact = units.weights(InternalForce(tolerance::kBalance)).value();
  // A rounded coordinate x turns a normal by up to rounding · |x| / r; each of about six contacts then errs
  // by that times its force.
  double extent = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Disk& disk : packing.disks) {
    extent = std::max(extent, disk.position.lpNorm<Eigen::Infinity>());
    smallest = std::min(smallest, disk.radius);
  }
  double largest_force = 0;
  for (const Contact& contact : packing.contacts) {
    largest_force = std::max({largest_force, std::abs(contact.R), std::abs(contact.T)});
  }
  if (packing.disks.empty() || !std::isfinite(largest_force)) return exact;
  const double rounded = 6 * imported.rounding * (1 + extent / smallest) * largest_force;
  return std::max(exact, units.weights(SceneForce(rounded)).value());
}

void require_balance(const ImportedPacking& imported, const BalanceReport& report, double tolerance) {
  const double worst = std::max(report.force_residual, report.torque_residual);
  if (report.checked_disks == 0 && !report.forces_known) return;
  if (worst <= tolerance && report.wall_residual <= tolerance) return;
  if (report.wall_residual > worst) {
    const Wall& wall = imported.packing[report.worst_wall];
    throw InputError(fmt::format(
        "the forces do not balance: on wall {} the net force is {:.3g} mg, above {:.3g} mg. Are load_n and "
        "load_t what pushes this wall, and are all of its contacts listed? If the deviation is acceptable, "
        "raise --balance-tol; the ranges do not depend on the simulated forces.",
        wall.name.empty() ? fmt::format("{}", wall.id) : wall.name, report.wall_residual, tolerance));
  }
  const bool force = report.force_residual >= report.torque_residual;
  const DiskId disk = force ? report.worst_force : report.worst_torque;
  const bool loose = std::none_of(
      imported.packing.contacts.begin(), imported.packing.contacts.end(),
      [&](const Contact& c) { return c.a == disk || (!c.b.is_wall() && c.b.disk_id() == disk); });
  std::string message = fmt::format(
      "the forces do not balance: on disk {} the net {} is {:.3g} mg, above {:.3g} mg. ",
      imported.packing[disk].id, force ? "force" : "torque (divided by its radius)", worst, tolerance);
  if (loose) {
    message += "This disk has no contact: leave it out, or give the contacts that hold it.";
  } else {
    message +=
        "Is the packing at rest, are gravity and loads those of the simulation, are all contacts listed "
        "and their forces the normal and tangential ones on body a?";
    const auto causes =
        report.forces_known ? find_causes(imported, tolerance) : std::vector<ImbalanceCause>{};
    for (const ImbalanceCause& cause : causes) {
      message += fmt::format("\n  {} {}", cause.explains ? "→" : "-", cause.text);
    }
    message +=
        "\nIf the deviation is acceptable, raise --balance-tol; the ranges do not depend on the simulated "
        "forces.";
  }
  throw InputError(message);
}

}  // namespace indet
