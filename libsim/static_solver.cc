#include "libsim/static_solver.h"

#include <algorithm>
#include <vector>

#include "libsim/contact_solver.h"
#include "libsim/polish.h"

namespace indet::sim {
namespace {

/// Velocities are recomputed from the forces after this many sweeps, so that rounding does not pile up in
/// them.
constexpr int kSweepsPerRound = 2000;

/// Accelerations of all bodies under the external wrench alone; the last row is the walls'.
std::vector<SolverBody> free_bodies(const Packing& packing) {
  std::vector<SolverBody> bodies;
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Disk& disk = packing[DiskId(i)];
    const Vector3 wrench = packing.wrench(DiskId(i));
    bodies.push_back({.vx = wrench.x() / disk.mass,
                      .vy = wrench.y() / disk.mass,
                      .s = disk.radius * wrench.z() / disk.inertia});
  }
  bodies.push_back({});
  return bodies;
}

SolverContact solver_contact(const Packing& packing, const Contact& contact) {
  SolverContact c;
  c.a = contact.a.value();
  c.nx = contact.normal.x();
  c.ny = contact.normal.y();
  c.mu = contact.mu;
  const Disk& a = packing[contact.a];
  c.inverse_mass_a = 1 / a.mass;
  c.inverse_spin_a = a.radius * a.radius / a.inertia;
  if (contact.b.is_wall()) {
    c.b = packing.disk_count();
  } else {
    c.b = contact.b.disk_id().value();
    const Disk& b = packing[contact.b.disk_id()];
    c.inverse_mass_b = 1 / b.mass;
    c.inverse_spin_b = b.radius * b.radius / b.inertia;
  }
  c.prepare();
  return c;
}

}  // namespace

StaticForces solve_statics(const Packing& packing, const Eigen::VectorXd& initial,
                           const StaticOptions& options) {
  const ForceUnits units = packing.force_units();
  std::vector<SolverContact> contacts;
  for (int i = 0; i < packing.contact_count(); ++i) {
    SolverContact contact = solver_contact(packing, packing[ContactId(i)]);
    contact.p_n = initial[2 * i];
    contact.p_t = initial[2 * i + 1];
    contacts.push_back(contact);
  }
  const std::vector<SolverBody> start = free_bodies(packing);
  StaticForces result;
  ContactSolver solver;
  while (!result.converged && result.sweeps < options.max_sweeps) {
    std::vector<SolverBody> bodies = start;
    apply_impulses(contacts, bodies);
    const auto left = static_cast<int>(options.max_sweeps - result.sweeps);
    const SweepReport report = solver.solve(contacts, bodies,
                                            {.max_sweeps = std::min(left, kSweepsPerRound),
                                             .tolerance = options.tolerance * units.internal_in_scene()});
    result.sweeps += report.sweeps;
    result.change = report.change / units.weight_in_scene();
    result.converged = report.converged;
    if (contacts.empty()) break;
  }
  result.forces.resize(2 * packing.contact_count());
  for (int i = 0; i < packing.contact_count(); ++i) {
    result.forces[2 * i] = contacts[static_cast<std::size_t>(i)].p_n;
    result.forces[2 * i + 1] = contacts[static_cast<std::size_t>(i)].p_t;
  }
  result.residual = balance_residual(packing, result.forces);
  return result;
}

}  // namespace indet::sim
