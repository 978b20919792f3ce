#include "indet/sim/explicit_stepper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace indet::sim {
namespace {

/// Neighbour lists reach this many units of length further than contact.
constexpr double kSkin = 0.05;

}  // namespace

ExplicitStepper::ExplicitStepper(World world, const std::vector<ContactState>& contacts, const SpringLaw& law,
                                 double dt)
    : world_(std::move(world)), law_(law), dt_(dt), neighbours_(kSkin * world_.units().length) {
  const int n = world_.size();
  bodies_.resize(n);
  forces_.resize(n);
  for (int i = 0; i < n; ++i) {
    kicks_.push_back({.per_force = dt / world_.mass[i],
                      .per_torque = dt * world_.radius[i] * world_.radius[i] / world_.inertia[i]});
    loads_.push_back({world_.load_x[i], world_.load_y[i], world_.load_torque[i] / world_.radius[i]});
  }
  fall_ = dt * world_.gravity;
  const auto is_zero = [](const Force& load) { return load.x == 0 && load.y == 0 && load.t == 0; };
  if (std::all_of(loads_.begin(), loads_.end(), is_zero)) loads_.clear();
  neighbours_.rebuild(world_, 0);
  place_springs(contacts);
}

void ExplicitStepper::load() {
  for (int i = 0; i < world_.size(); ++i) {
    bodies_[i] = {world_.x[i],
                  world_.y[i],
                  world_.vx[i],
                  world_.vy[i],
                  world_.radius[i] * world_.omega[i],
                  world_.radius[i],
                  0};
  }
}

void ExplicitStepper::store() {
  for (int i = 0; i < world_.size(); ++i) {
    world_.x[i] = bodies_[i].x;
    world_.y[i] = bodies_[i].y;
    world_.vx[i] = bodies_[i].vx;
    world_.vy[i] = bodies_[i].vy;
    world_.omega[i] = bodies_[i].s / bodies_[i].r;
    world_.angle[i] += bodies_[i].rolled / bodies_[i].r;
    bodies_[i].rolled = 0;
  }
}

void ExplicitStepper::place_springs(const std::vector<ContactState>& contacts) {
  springs_.assign(neighbours_.partners().size(), 0.0);
  wall_springs_.assign(neighbours_.walls().size(), 0.0);
  for (const ContactState& contact : contacts) {
    const bool wall = contact.b < 0;
    const std::vector<int>& first = wall ? neighbours_.first_wall() : neighbours_.first();
    const std::vector<int>& partners = wall ? neighbours_.walls() : neighbours_.partners();
    const auto begin = partners.begin() + first[contact.a];
    const auto end = partners.begin() + first[contact.a + 1];
    const auto found = std::lower_bound(begin, end, wall ? -contact.b - 1 : contact.b);
    (wall ? wall_springs_ : springs_)[found - partners.begin()] = contact.spring;
  }
}

void ExplicitStepper::refresh_neighbours() {
  // Positions only: the sums behind the angles must not depend on when lists are made.
  for (int i = 0; i < world_.size(); ++i) {
    world_.x[i] = bodies_[i].x;
    world_.y[i] = bodies_[i].y;
  }
  const std::vector<ContactState> touching = state();
  if (neighbours_.update(world_, 0)) {
    place_springs(touching);
    path_ = 0;
    return;
  }
  path_ = neighbours_.farthest_move(world_);
}

std::vector<ContactState> ExplicitStepper::state() const {
  std::vector<ContactState> contacts;
  for (int i = 0; i < world_.size(); ++i) {
    for (int k = neighbours_.first_wall()[i]; k < neighbours_.first_wall()[i + 1]; ++k) {
      contacts.push_back(
          {.a = i, .b = -neighbours_.walls()[k] - 1, .mu = world_.friction.wall, .spring = wall_springs_[k]});
    }
    for (int k = neighbours_.first()[i]; k < neighbours_.first()[i + 1]; ++k) {
      contacts.push_back(
          {.a = i, .b = neighbours_.partners()[k], .mu = world_.friction.disk, .spring = springs_[k]});
    }
  }
  return elastic_forces(world_, contacts, law_.k);
}

std::vector<ContactState> ExplicitStepper::forces() const { return state(); }

template <bool kFriction>
void ExplicitStepper::add_forces() {
  const SpringLaw law = law_;
  const double mu = world_.friction.disk;
  const double mu_wall = world_.friction.wall;
  const int* first = neighbours_.first().data();
  const int* partners = neighbours_.partners().data();
  const int* first_wall = neighbours_.first_wall().data();
  const int n = world_.size();
  const double dt = dt_;
  const Body* bodies = bodies_.data();
  Force* forces = forces_.data();
  double* springs = springs_.data();
  for (int i = 0; i < n; ++i) {
    const Body a = bodies[i];
    Force sum = forces[i];
    for (int k = first_wall[i]; k < first_wall[i + 1]; ++k) {
      const Wall& wall = world_.walls[neighbours_.walls()[k]];
      const double nx = wall.normal.x();
      const double ny = wall.normal.y();
      const double gap = (a.x - wall.point.x()) * nx + (a.y - wall.point.y()) * ny - a.r;
      if (gap >= 0) {
        wall_springs_[k] = 0;
        continue;
      }
      const double R = law.normal_force(gap, nx * a.vx + ny * a.vy);
      sum.x += R * nx;
      sum.y += R * ny;
      if constexpr (kFriction) {
        const double u_t = ny * a.vx - nx * a.vy + a.s;
        const auto tangential = law.tangential_force(wall_springs_[k] + dt * u_t, u_t, mu_wall * R);
        wall_springs_[k] = tangential.spring;
        sum.x += tangential.T * ny;
        sum.y -= tangential.T * nx;
        sum.t += tangential.T;
      }
    }
    for (int k = first[i]; k < first[i + 1]; ++k) {
      const int j = partners[k];
      const Body& b = bodies[j];
      const double dx = a.x - b.x;
      const double dy = a.y - b.y;
      const double square = dx * dx + dy * dy;
      const double touching = a.r + b.r;
      if (square >= touching * touching) {
        if constexpr (kFriction) springs[k] = 0;
        continue;
      }
      const double distance = std::sqrt(square);
      const double inverse = 1 / distance;
      const double nx = dx * inverse;
      const double ny = dy * inverse;
      const double ux = a.vx - b.vx;
      const double uy = a.vy - b.vy;
      const double R = law.normal_force(distance - touching, nx * ux + ny * uy);
      double fx = R * nx;
      double fy = R * ny;
      if constexpr (kFriction) {
        const double u_t = ny * ux - nx * uy + a.s + b.s;
        const auto tangential = law.tangential_force(springs[k] + dt * u_t, u_t, mu * R);
        springs[k] = tangential.spring;
        fx += tangential.T * ny;
        fy -= tangential.T * nx;
        sum.t += tangential.T;
        forces[j].t += tangential.T;
      }
      sum.x += fx;
      sum.y += fy;
      forces[j].x -= fx;
      forces[j].y -= fy;
    }
    forces[i] = sum;
  }
}

template <bool kFriction>
double ExplicitStepper::move() {
  double fastest = 0;
  const double dt = dt_;
  const double fall_x = fall_.x();
  const double fall_y = fall_.y();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    Force& force = forces_[i];
    const Kick& kick = kicks_[i];
    body.vx += fall_x + kick.per_force * force.x;
    body.vy += fall_y + kick.per_force * force.y;
    if constexpr (kFriction) {
      body.s += kick.per_torque * force.t;
      body.rolled += dt * body.s;
    }
    force = loads_.empty() ? Force{0, 0, 0} : loads_[i];
    body.x += dt * body.vx;
    body.y += dt * body.vy;
    fastest = std::max(fastest, body.vx * body.vx + body.vy * body.vy);
  }
  return fastest;
}

template <bool kFriction>
void ExplicitStepper::advance_as(int steps) {
  for (int i = 0; i < steps; ++i) {
    if (path_ > neighbours_.skin() / 2) refresh_neighbours();
    add_forces<kFriction>();
    path_ += dt_ * std::sqrt(move<kFriction>());
  }
}

void ExplicitStepper::advance(int steps) {
  load();
  if (loads_.empty()) {
    std::fill(forces_.begin(), forces_.end(), Force{0, 0, 0});
  } else {
    forces_ = loads_;
  }
  if (world_.friction.any()) {
    advance_as<true>(steps);
  } else {
    advance_as<false>(steps);
  }
  store();
  report_.steps += steps;
}

double stiffness_factor(const World& world) {
  const double smallest = *std::min_element(world.radius.begin(), world.radius.end());
  double factor = 0;
  for (int i = 0; i < world.size(); ++i) {
    const double around =
        std::floor(std::numbers::pi / std::asin(smallest / (world.radius[i] + smallest)) + 1e-9);
    double response = 1 / world.mass[i];
    if (world.friction.any())
      response = std::max(response, world.radius[i] * world.radius[i] / world.inertia[i]);
    factor = std::max(factor, 2 * around * response);
  }
  return factor;
}

double largest_explicit_step(const World& world, const SpringLaw& law) {
  // κk dt² + 2κγ dt − 4 = 0, written without cancellation.
  const double kappa = stiffness_factor(world);
  const double b = kappa * law.gamma;
  return 4 / (b + std::sqrt(b * b + 4 * kappa * law.k));
}

}  // namespace indet::sim
