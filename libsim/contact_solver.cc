#include "libsim/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace indet::sim {
namespace {

/// The largest change is looked for in one sweep out of this many.
constexpr int kCheckInterval = 8;
/// Rows that stand for bodies which do not move. Contacts take turns with them, so that none waits for
/// another.
constexpr int kSpareRows = 16;

bool any_friction(std::span<const SolverContact> contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const SolverContact& c) { return c.mu > 0; });
}

/// Compliance or bias: what the sweeps over frozen packings do without.
bool any_offset(std::span<const SolverContact> contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const SolverContact& c) {
    return c.compliance != 0 || c.bias_n != 0 || c.bias_t != 0;
  });
}

/// Levers that are not the radius.
bool any_arm(std::span<const SolverContact> contacts) {
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const SolverContact& c) { return c.arm_a != 1 || c.arm_b != 1; });
}

bool moves(const SolverContact& c) { return c.inverse_mass_b > 0 || c.inverse_spin_b > 0; }

}  // namespace

void SolverContact::prepare() {
  const double w_n = inverse_mass_a + inverse_mass_b;
  scale_n = 1 / (w_n + compliance);
  scale_t = 1 / (w_n + arm_a * arm_a * inverse_spin_a + arm_b * arm_b * inverse_spin_b + compliance);
}

void apply_impulses(std::span<const SolverContact> contacts, std::span<SolverBody> bodies) {
  for (const SolverContact& c : contacts) {
    SolverBody& a = bodies[c.a];
    SolverBody& b = bodies[c.b];
    const double px = c.nx * c.p_n + c.ny * c.p_t;
    const double py = c.ny * c.p_n - c.nx * c.p_t;
    a.s += c.arm_a * c.inverse_spin_a * c.p_t;
    b.s += c.arm_b * c.inverse_spin_b * c.p_t;
    a.vx += c.inverse_mass_a * px;
    a.vy += c.inverse_mass_a * py;
    b.vx -= c.inverse_mass_b * px;
    b.vy -= c.inverse_mass_b * py;
  }
}

void ContactSolver::load(std::span<const SolverContact> contacts, std::span<const SolverBody> bodies) {
  const int count = static_cast<int>(bodies.size());
  std::vector<ContactEnds> ends;
  ends.reserve(contacts.size());
  for (const SolverContact& c : contacts) ends.push_back({c.a, moves(c) ? c.b : -1});
  if (ends != ends_) {
    order_ = sweep_order(ends, count);
    ends_ = std::move(ends);
  }

  rows_.assign(bodies.size() + kSpareRows, Row{});
  for (std::size_t i = 0; i < bodies.size(); ++i)
    rows_[i] = {.v = Lanes{bodies[i].vx, bodies[i].vy}, .s = bodies[i].s};

  int spare = 0;
  const auto next_spare = [&] { return count + spare++ % kSpareRows; };
  pairs_.assign(order_.size(), Pair{});
  for (std::size_t i = 0; i < order_.size(); ++i) {
    Pair& pair = pairs_[i];
    for (std::size_t lane = 0; lane < 2; ++lane) {
      if (order_[i][lane] < 0) {
        pair.a[lane] = pair.b[lane] = next_spare();
        continue;
      }
      const SolverContact& c = contacts[order_[i][lane]];
      pair.a[lane] = c.a;
      pair.b[lane] = moves(c) ? c.b : next_spare();
      pair.nx[lane] = c.nx;
      pair.ny[lane] = c.ny;
      pair.p_n[lane] = c.p_n;
      pair.p_t[lane] = c.p_t;
      pair.bias_n[lane] = c.bias_n;
      pair.bias_t[lane] = c.bias_t;
      pair.compliance[lane] = c.compliance;
      pair.scale_n[lane] = c.scale_n;
      pair.scale_t[lane] = c.scale_t;
      pair.mu[lane] = c.mu;
      pair.inverse_mass_a[lane] = c.inverse_mass_a;
      pair.inverse_mass_b[lane] = c.inverse_mass_b;
      pair.turn_a[lane] = c.arm_a * c.inverse_spin_a;
      pair.turn_b[lane] = c.arm_b * c.inverse_spin_b;
      pair.arm_a[lane] = c.arm_a;
      pair.arm_b[lane] = c.arm_b;
    }
  }
}

void ContactSolver::store(std::span<SolverContact> contacts, std::span<SolverBody> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    bodies[i] = {.vx = rows_[i].v[0], .vy = rows_[i].v[1], .s = rows_[i].s};
  for (std::size_t i = 0; i < order_.size(); ++i) {
    for (std::size_t lane = 0; lane < 2; ++lane) {
      if (order_[i][lane] < 0) continue;
      contacts[order_[i][lane]].p_n = pairs_[i].p_n[lane];
      contacts[order_[i][lane]].p_t = pairs_[i].p_t[lane];
    }
  }
}

template <bool kFriction, bool kArms, bool kOffset, bool kMeasure>
double ContactSolver::sweep() {
  const Lanes zero = both(0);
  Lanes change = zero;
  Row* rows = rows_.data();
  for (Pair& c : pairs_) {
    Row& a0 = rows[c.a[0]];
    Row& b0 = rows[c.b[0]];
    Row& a1 = rows[c.a[1]];
    Row& b1 = rows[c.b[1]];
    const Lanes u0 = a0.v - b0.v;
    const Lanes u1 = a1.v - b1.v;
    const Lanes ux = first_of(u0, u1);
    const Lanes uy = second_of(u0, u1);
    Lanes u_n = c.nx * ux + c.ny * uy;
    if constexpr (kOffset) u_n = u_n + c.compliance * c.p_n + c.bias_n;
    const Lanes p_n = larger(c.p_n - u_n * c.scale_n, zero);
    const Lanes d_n = p_n - c.p_n;
    c.p_n = p_n;
    if constexpr (kMeasure) change = larger(change, larger(d_n, -d_n));
    Lanes px = c.nx * d_n;
    Lanes py = c.ny * d_n;
    if constexpr (kFriction) {
      Lanes turn_of_a{a0.s, a1.s};
      Lanes turn_of_b{b0.s, b1.s};
      if constexpr (kArms) {
        turn_of_a = c.arm_a * turn_of_a;
        turn_of_b = c.arm_b * turn_of_b;
      }
      const Lanes turn = turn_of_a + turn_of_b;
      Lanes u_t = c.ny * ux - c.nx * uy + turn;
      if constexpr (kOffset) u_t = u_t + c.compliance * c.p_t + c.bias_t;
      const Lanes limit = c.mu * p_n;
      const Lanes free = c.p_t - u_t * c.scale_t;
      const Lanes p_t = smaller(larger(free, -limit), limit);
      const Lanes d_t = p_t - c.p_t;
      c.p_t = p_t;
      if constexpr (kMeasure) change = larger(change, larger(d_t, -d_t));
      px += c.ny * d_t;
      py -= c.nx * d_t;
      const Lanes turn_a = c.turn_a * d_t;
      const Lanes turn_b = c.turn_b * d_t;
      a0.s += turn_a[0];
      a1.s += turn_a[1];
      b0.s += turn_b[0];
      b1.s += turn_b[1];
    }
    const Lanes p0 = first_of(px, py);
    const Lanes p1 = second_of(px, py);
    a0.v += both(c.inverse_mass_a[0]) * p0;
    b0.v -= both(c.inverse_mass_b[0]) * p0;
    a1.v += both(c.inverse_mass_a[1]) * p1;
    b1.v -= both(c.inverse_mass_b[1]) * p1;
  }
  return std::max(change[0], change[1]);
}

template <bool kFriction, bool kArms, bool kOffset>
SweepReport ContactSolver::iterate(const SweepLimits& limits) {
  SweepReport report;
  while (report.sweeps < limits.max_sweeps) {
    ++report.sweeps;
    if (report.sweeps % kCheckInterval != 0 && report.sweeps != limits.max_sweeps) {
      sweep<kFriction, kArms, kOffset, false>();
      continue;
    }
    report.change = sweep<kFriction, kArms, kOffset, true>();
    report.converged = report.change <= limits.tolerance;
    if (report.converged) break;
  }
  return report;
}

SweepReport ContactSolver::solve(std::span<SolverContact> contacts, std::span<SolverBody> bodies,
                                 const SweepLimits& limits) {
  if (contacts.empty()) return {.converged = true};
  load(contacts, bodies);
  const bool offset = any_offset(contacts);
  SweepReport report;
  if (!any_friction(contacts)) {
    report = offset ? iterate<false, false, true>(limits) : iterate<false, false, false>(limits);
  } else if (any_arm(contacts)) {
    report = offset ? iterate<true, true, true>(limits) : iterate<true, true, false>(limits);
  } else {
    report = offset ? iterate<true, false, true>(limits) : iterate<true, false, false>(limits);
  }
  store(contacts, bodies);
  return report;
}

}  // namespace indet::sim
