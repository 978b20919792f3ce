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
    order_ = group_pairs(sweep_order(ends, count), ends);
    ends_ = std::move(ends);
  }

  rows_.assign(bodies.size() + kSpareRows, VelocityRow{});
  for (std::size_t i = 0; i < bodies.size(); ++i)
    rows_[i] = {.v = Lanes{bodies[i].vx, bodies[i].vy}, .s = Lanes{bodies[i].s, 0}};

  int spare = 0;
  const auto next_spare = [&] { return count + spare++ % kSpareRows; };
  groups_.assign(order_.size(), ContactGroup{});
  for (std::size_t i = 0; i < order_.size(); ++i) {
    ContactGroup& group = groups_[i];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if (order_[i][lane] < 0) {
        group.a[lane] = group.b[lane] = next_spare();
        continue;
      }
      const SolverContact& c = contacts[order_[i][lane]];
      group.a[lane] = c.a;
      group.b[lane] = moves(c) ? c.b : next_spare();
      group.nx.set(lane, c.nx);
      group.ny.set(lane, c.ny);
      group.p_n.set(lane, c.p_n);
      group.p_t.set(lane, c.p_t);
      group.bias_n.set(lane, c.bias_n);
      group.bias_t.set(lane, c.bias_t);
      group.compliance.set(lane, c.compliance);
      group.scale_n.set(lane, c.scale_n);
      group.scale_t.set(lane, c.scale_t);
      group.mu.set(lane, c.mu);
      group.inverse_mass_a.set(lane, c.inverse_mass_a);
      group.inverse_mass_b.set(lane, c.inverse_mass_b);
      group.turn_a.set(lane, c.arm_a * c.inverse_spin_a);
      group.turn_b.set(lane, c.arm_b * c.inverse_spin_b);
      group.arm_a.set(lane, c.arm_a);
      group.arm_b.set(lane, c.arm_b);
    }
  }
}

void ContactSolver::store(std::span<SolverContact> contacts, std::span<SolverBody> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    bodies[i] = {.vx = rows_[i].v[0], .vy = rows_[i].v[1], .s = rows_[i].s[0]};
  for (std::size_t i = 0; i < order_.size(); ++i) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if (order_[i][lane] < 0) continue;
      contacts[order_[i][lane]].p_n = groups_[i].p_n[lane];
      contacts[order_[i][lane]].p_t = groups_[i].p_t[lane];
    }
  }
}

SweepReport ContactSolver::solve(std::span<SolverContact> contacts, std::span<SolverBody> bodies,
                                 const SweepLimits& limits) {
  if (contacts.empty()) return {.converged = true};
  load(contacts, bodies);
  SweepParts parts{
      .friction = any_friction(contacts), .arms = any_arm(contacts), .offset = any_offset(contacts)};
  SweepReport report;
  while (report.sweeps < limits.max_sweeps && !report.converged) {
    ++report.sweeps;
    parts.measure = report.sweeps % kCheckInterval == 0 || report.sweeps == limits.max_sweeps;
    const double change = sweep(parts, groups_, rows_);
    if (!parts.measure) continue;
    report.change = change;
    report.converged = change <= limits.tolerance;
  }
  store(contacts, bodies);
  return report;
}

}  // namespace indet::sim
