#include "libsim/static_solver.h"

#include <algorithm>
#include <vector>

#include "libsim/polish.h"
#include "libsim/unsupported.h"

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
    if (disk.fixed) {
      bodies.push_back({});
      continue;
    }
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
  if (packing.has_equations(contact.a)) {
    const Disk& a = packing[contact.a];
    c.inverse_mass_a = 1 / a.mass;
    c.inverse_spin_a = a.radius * a.radius / a.inertia;
    c.arm_a = packing.lever_a(contact) / a.radius;
  }
  c.b = contact.b.is_wall() ? packing.disk_count() : contact.b.disk_id().value();
  if (packing.is_free_disk(contact.b)) {
    const Disk& b = packing[contact.b.disk_id()];
    c.inverse_mass_b = 1 / b.mass;
    c.inverse_spin_b = b.radius * b.radius / b.inertia;
    c.arm_b = packing.lever_b(contact) / b.radius;
  }
  c.prepare();
  return c;
}

}  // namespace

StaticSolver::StaticSolver(const Packing& packing)
    : packing_(packing), units_(packing.force_units()), free_bodies_(free_bodies(packing)) {
  refuse_unsupported(packing, "the iterative solver");
  for (const Contact& contact : packing.contacts) contacts_.push_back(solver_contact(packing, contact));
}

StaticForces StaticSolver::solve(const Eigen::VectorXd& initial, const StaticOptions& options) {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].p_n = initial[2 * static_cast<Eigen::Index>(i)];
    contacts_[i].p_t = initial[2 * static_cast<Eigen::Index>(i) + 1];
  }
  StaticForces result;
  while (!result.converged && result.sweeps < options.max_sweeps) {
    bodies_ = free_bodies_;
    apply_impulses(contacts_, bodies_);
    const auto left = static_cast<int>(options.max_sweeps - result.sweeps);
    const SweepReport report = solver_.solve(contacts_, bodies_,
                                             {.max_sweeps = std::min(left, kSweepsPerRound),
                                              .tolerance = options.tolerance * units_.internal_in_scene()});
    result.sweeps += report.sweeps;
    result.change = report.change / units_.weight_in_scene();
    result.converged = report.converged;
    if (contacts_.empty()) break;
  }
  result.forces.resize(initial.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    result.forces[2 * static_cast<Eigen::Index>(i)] = contacts_[i].p_n;
    result.forces[2 * static_cast<Eigen::Index>(i) + 1] = contacts_[i].p_t;
  }
  result.residual = balance_residual(packing_, result.forces);
  return result;
}

StaticForces solve_statics(const Packing& packing, const Eigen::VectorXd& initial,
                           const StaticOptions& options) {
  return StaticSolver(packing).solve(initial, options);
}

}  // namespace indet::sim
