#include "libsim/implicit_stepper.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace indet::sim {
namespace {

/// Neighbour lists are made for gaps up to this many units of length beyond what a step needs.
constexpr double kSkin = 0.1;
/// Pairs nearer than a step at this speed count as possible contacts even if they are at rest: a neighbour
/// may be pushed towards them within the step.
constexpr double kPushSpeed = 0.2;

std::pair<int, int> key(const ContactState& contact) { return {contact.a, contact.b}; }

}  // namespace

ImplicitStepper::ImplicitStepper(World world, std::vector<ContactState> contacts,
                                 const ImplicitOptions& options)
    : world_(std::move(world)),
      options_(options),
      neighbours_(kSkin * world_.units().length),
      contacts_(std::move(contacts)) {
  const Units units = world_.units();
  force_unit_ = units.force;
  near_gap_ = kPushSpeed * units.speed() * options_.dt;
  const int n = world_.size();
  bodies_.resize(n + 1);
  inverse_mass_.assign(n + 1, 0.0);
  inverse_spin_.assign(n + 1, 0.0);
  speed_.resize(n);
  for (int i = 0; i < n; ++i) {
    if (world_.fixed[i]) continue;
    inverse_mass_[i] = 1 / world_.mass[i];
    inverse_spin_[i] = world_.radius[i] * world_.radius[i] / world_.inertia[i];
  }
}

void ImplicitStepper::advance(int steps) {
  for (int i = 0; i < steps; ++i) step();
}

void ImplicitStepper::step() {
  find_contacts();
  const double dt = options_.dt;
  const int n = world_.size();
  for (int i = 0; i < n; ++i) {
    if (world_.fixed[i]) continue;
    bodies_[i].vx = world_.vx[i] + dt * (world_.gravity.x() + world_.load_x[i] * inverse_mass_[i]);
    bodies_[i].vy = world_.vy[i] + dt * (world_.gravity.y() + world_.load_y[i] * inverse_mass_[i]);
    bodies_[i].s = world_.radius[i] * (world_.omega[i] + dt * world_.load_torque[i] / world_.inertia[i]);
  }
  bodies_[n] = SolverBody{};
  apply_impulses(solver_, bodies_);
  double change = 0;
  for (const ContactState& contact : previous_) change = std::max(change, contact.change);
  const double tolerance = std::max(options_.tolerance * force_unit_, options_.loosening * change);
  const int most_sweeps = starts_from_zero_ ? options_.start_sweeps : options_.max_sweeps;
  const SweepReport sweeps =
      gauss_seidel_.solve(solver_, bodies_, {.max_sweeps = most_sweeps, .tolerance = tolerance * dt});
  ++report_.steps;
  report_.capped_steps += sweeps.converged ? 0 : 1;
  report_.sweeps += sweeps.sweeps;
  report_.contact_updates +=
      static_cast<std::int64_t>(sweeps.sweeps) * static_cast<std::int64_t>(solver_.size());
  finish();
}

void ImplicitStepper::find_contacts() {
  const int n = world_.size();
  const double dt = options_.dt;
  const double pull = world_.gravity.norm() * dt;
  double fastest = 0;
  for (int i = 0; i < n; ++i) {
    speed_[i] = std::sqrt(world_.vx[i] * world_.vx[i] + world_.vy[i] * world_.vy[i]) + pull;
    fastest = std::max(fastest, speed_[i]);
  }
  const double needed = near_gap_ + 2 * dt * fastest;
  if (needed > reach_ || needed < reach_ / 8) reach_ = 2 * needed;
  neighbours_.update(world_, reach_);

  std::swap(contacts_, previous_);
  contacts_.clear();
  solver_.clear();
  for (int i = 0; i < n; ++i) {
    const double xi = world_.x[i];
    const double yi = world_.y[i];
    const double ri = world_.radius[i];
    for (const int w : neighbours_.walls_near(i)) {
      const Wall& wall = world_.walls[w];
      const double height = (xi - wall.point.x()) * wall.normal.x() + (yi - wall.point.y()) * wall.normal.y();
      const double gap = height - ri;
      if (gap > near_gap_ + dt * speed_[i]) continue;
      add_contact(i, -(w + 1), wall.normal.x(), wall.normal.y(), gap, world_.friction.wall);
    }
    for (const int j : neighbours_.disks_near(i)) {
      const double dx = xi - world_.x[j];
      const double dy = yi - world_.y[j];
      const double touching = ri + world_.radius[j];
      const double reach = touching + near_gap_ + dt * (speed_[i] + speed_[j]);
      const double square = dx * dx + dy * dy;
      if (square > reach * reach) continue;
      const double distance = std::sqrt(square);
      add_contact(i, j, dx / distance, dy / distance, distance - touching, world_.friction.disk);
    }
  }
  starts_from_zero_ = !carry_over();
  for (std::size_t i = 0; i < solver_.size(); ++i) {
    if (options_.springs) {
      const SpringLaw& law = *options_.springs;
      const double resistance = law.gamma + law.k * dt;
      solver_[i].compliance = 1 / (dt * resistance);
      solver_[i].bias_n =
          contacts_[i].gap > 0 ? contacts_[i].gap / dt : law.k * contacts_[i].gap / resistance;
      solver_[i].bias_t = law.k * contacts_[i].spring / resistance;
    }
    solver_[i].prepare();
  }
}

void ImplicitStepper::add_contact(int a, int b, double nx, double ny, double gap, double mu) {
  const int wall_row = world_.size();
  const int row = b < 0 ? wall_row : b;
  SolverContact contact;
  contact.a = a;
  contact.b = row;
  contact.nx = nx;
  contact.ny = ny;
  contact.mu = mu;
  contact.inverse_mass_a = inverse_mass_[a];
  contact.inverse_mass_b = inverse_mass_[row];
  contact.inverse_spin_a = inverse_spin_[a];
  contact.inverse_spin_b = inverse_spin_[row];
  if (!world_.levers.empty()) {
    const Arms arms = world_.arms_of(a, b);
    contact.arm_a = arms.a;
    contact.arm_b = b < 0 ? 1 : arms.b;
  }
  if (!options_.springs) {
    const RigidLaw& law = options_.rigid;
    contact.bias_n = (gap > 0 ? 1 : law.alpha) * gap / options_.dt;
    if (law.restitution_n > 0 || law.restitution_t > 0) {
      const double ux = world_.vx[a] - (b < 0 ? 0 : world_.vx[b]);
      const double uy = world_.vy[a] - (b < 0 ? 0 : world_.vy[b]);
      const double spin = contact.arm_a * world_.radius[a] * world_.omega[a] +
                          (b < 0 ? 0 : contact.arm_b * world_.radius[b] * world_.omega[b]);
      if (law.restitution_n > 0) {
        if (gap > 0) return;
        contact.bias_n = std::min(contact.bias_n, law.restitution_n * (nx * ux + ny * uy));
      }
      contact.bias_t = law.restitution_t * (ny * ux - nx * uy + spin);
    }
  }
  solver_.push_back(contact);
  contacts_.push_back({.a = a, .b = b, .nx = nx, .ny = ny, .gap = gap, .mu = mu});
}

bool ImplicitStepper::carry_over() {
  // Both lists are sorted by a; within one a walls come first, in the order of the wall, then disks.
  const auto before = [](const ContactState& p, const ContactState& q) {
    const auto rank = [](const ContactState& c) { return std::tuple(c.a, c.b >= 0, c.b >= 0 ? c.b : -c.b); };
    return rank(p) < rank(q);
  };
  const double dt = options_.dt;
  bool any = false;
  auto old = previous_.begin();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    while (old != previous_.end() && before(*old, contacts_[i])) ++old;
    if (old == previous_.end()) break;
    if (key(*old) != key(contacts_[i])) continue;
    solver_[i].p_n = old->R * dt;
    solver_[i].p_t = old->T * dt;
    contacts_[i].spring = old->spring;
    contacts_[i].R = old->R;
    any = true;
  }
  return any;
}

void ImplicitStepper::finish() {
  const double dt = options_.dt;
  const int n = world_.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < solver_.size(); ++i) {
    const SolverContact& solved = solver_[i];
    if (!(solved.p_n > 0)) continue;
    ContactState& contact = contacts_[i];
    contact.change = std::abs(solved.p_n / dt - contact.R);
    contact.R = solved.p_n / dt;
    contact.T = solved.p_t / dt;
    contact.sliding = contact.mu > 0 && std::abs(solved.p_t) >= contact.mu * solved.p_n;
    if (options_.springs && contact.mu > 0) {
      const SolverBody& a = bodies_[solved.a];
      const SolverBody& b = bodies_[solved.b];
      const double u_t =
          solved.ny * (a.vx - b.vx) - solved.nx * (a.vy - b.vy) + solved.arm_a * a.s + solved.arm_b * b.s;
      contact.spring = contact.sliding ? -contact.T / options_.springs->k : contact.spring + dt * u_t;
    }
    contacts_[kept++] = contact;
  }
  contacts_.resize(kept);
  report_.contacts = static_cast<int>(kept);
  for (int i = 0; i < n; ++i) {
    world_.vx[i] = bodies_[i].vx;
    world_.vy[i] = bodies_[i].vy;
    world_.omega[i] = bodies_[i].s / world_.radius[i];
    world_.x[i] += dt * world_.vx[i];
    world_.y[i] += dt * world_.vy[i];
    world_.angle[i] += dt * world_.omega[i];
  }
}

std::vector<ContactState> ImplicitStepper::state() const { return contacts_; }

std::vector<ContactState> ImplicitStepper::forces() const {
  if (!options_.springs) return contacts_;
  return elastic_forces(world_, contacts_, options_.springs->k);
}

}  // namespace indet::sim
