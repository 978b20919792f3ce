#include "indet/sim/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace indet::sim {
namespace {

/// The largest change is looked for in one sweep out of this many.
constexpr int kCheckInterval = 8;

/// Adds an impulse (p_n, p_t) of a contact to the velocities of its bodies.
template <bool kFriction>
inline void push(const SolverContact& c, SolverBody& a, SolverBody& b, double p_n, double p_t) {
  double px = c.nx * p_n;
  double py = c.ny * p_n;
  if constexpr (kFriction) {
    px += c.ny * p_t;
    py -= c.nx * p_t;
    a.s += c.inverse_spin_a * p_t;
    b.s += c.inverse_spin_b * p_t;
  }
  a.vx += c.inverse_mass_a * px;
  a.vy += c.inverse_mass_a * py;
  b.vx -= c.inverse_mass_b * px;
  b.vy -= c.inverse_mass_b * py;
}

template <bool kFriction, bool kMeasure>
double sweep(std::span<SolverContact> contacts, SolverBody* bodies) {
  double change = 0;
  for (SolverContact& c : contacts) {
    SolverBody& a = bodies[c.a];
    SolverBody& b = bodies[c.b];
    const double ux = a.vx - b.vx;
    const double uy = a.vy - b.vy;
    const double u_n = c.nx * ux + c.ny * uy;
    const double p_n = std::max(0.0, c.p_n - (u_n + c.compliance * c.p_n + c.bias_n) * c.scale_n);
    const double d_n = p_n - c.p_n;
    double d_t = 0;
    if constexpr (kFriction) {
      const double u_t = c.ny * ux - c.nx * uy + a.s + b.s;
      const double limit = c.mu * p_n;
      const double free = c.p_t - (u_t + c.compliance * c.p_t + c.bias_t) * c.scale_t;
      const double p_t = std::min(limit, std::max(-limit, free));
      d_t = p_t - c.p_t;
      c.p_t = p_t;
    }
    c.p_n = p_n;
    push<kFriction>(c, a, b, d_n, d_t);
    if constexpr (kMeasure) change = std::max({change, std::abs(d_n), std::abs(d_t)});
  }
  return change;
}

template <bool kFriction>
SweepReport iterate(std::span<SolverContact> contacts, SolverBody* bodies, const SweepLimits& limits) {
  SweepReport report;
  while (report.sweeps < limits.max_sweeps) {
    ++report.sweeps;
    if (report.sweeps % kCheckInterval != 0 && report.sweeps != limits.max_sweeps) {
      sweep<kFriction, false>(contacts, bodies);
      continue;
    }
    report.change = sweep<kFriction, true>(contacts, bodies);
    report.converged = report.change <= limits.tolerance;
    if (report.converged) break;
  }
  return report;
}

bool any_friction(std::span<const SolverContact> contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const SolverContact& c) { return c.mu > 0; });
}

}  // namespace

void SolverContact::prepare() {
  const double w_n = inverse_mass_a + inverse_mass_b;
  scale_n = 1 / (w_n + compliance);
  scale_t = 1 / (w_n + inverse_spin_a + inverse_spin_b + compliance);
}

void apply_impulses(std::span<const SolverContact> contacts, std::span<SolverBody> bodies) {
  for (const SolverContact& c : contacts) push<true>(c, bodies[c.a], bodies[c.b], c.p_n, c.p_t);
}

SweepReport solve(std::span<SolverContact> contacts, std::span<SolverBody> bodies,
                  const SweepLimits& limits) {
  if (contacts.empty()) return {.converged = true};
  return any_friction(contacts) ? iterate<true>(contacts, bodies.data(), limits)
                                : iterate<false>(contacts, bodies.data(), limits);
}

}  // namespace indet::sim
