#include "libsim/explicit_stepper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "libindet/base/tolerances.h"

namespace indet::sim {
namespace {

/// Neighbour lists reach as far as two disks come nearer to each other in so many steps, within these bounds
/// (units of length). Packings at rest have short lists, with few pairs that do not touch. Results do not
/// depend on it: a pair that does not touch adds 0 to the forces.
constexpr double kStepsBetweenLists = 300;
constexpr double kLeastSkin = 0.002;
constexpr double kGreatestSkin = 0.1;

}  // namespace

ExplicitStepper::ExplicitStepper(World world, const std::vector<ContactState>& contacts, const SpringLaw& law,
                                 double dt)
    : world_(std::move(world)), law_(law), dt_(dt), neighbours_(suitable_skin()) {
  const int n = world_.size();
  bodies_.assign(n + 2, Body{});
  bodies_[n + 1].x = both(world_.units().length);
  bool loaded = false;
  for (int i = 0; i < n; ++i) {
    if (world_.fixed[i]) {
      held_ = true;
      loads_.push_back({both(0), 0});
      continue;
    }
    bodies_[i].per_force = dt / world_.mass[i];
    bodies_[i].per_torque = dt * world_.radius[i] * world_.radius[i] / world_.inertia[i];
    loads_.push_back({Lanes{world_.load_x[i], world_.load_y[i]}, world_.load_torque[i] / world_.radius[i]});
    loaded = loaded || world_.load_x[i] != 0 || world_.load_y[i] != 0 || world_.load_torque[i] != 0;
  }
  if (!loaded) loads_.clear();
  set_gravity(world_.gravity);
  neighbours_.rebuild(world_, 0);
  place_springs(contacts);
}

void ExplicitStepper::set_gravity(const Vector2& gravity) {
  world_.gravity = gravity;
  fall_ = Lanes{dt_ * gravity.x(), dt_ * gravity.y()};
}

double ExplicitStepper::suitable_skin() const {
  const double unit = world_.units().length;
  return std::clamp(2 * kStepsBetweenLists * dt_ * world_.fastest_speed(), kLeastSkin * unit,
                    kGreatestSkin * unit);
}

void ExplicitStepper::load() {
  for (int i = 0; i < world_.size(); ++i) {
    bodies_[i].x = Lanes{world_.x[i], world_.y[i]};
    bodies_[i].v = Lanes{world_.vx[i], world_.vy[i]};
    bodies_[i].turn = Lanes{world_.radius[i] * world_.omega[i], world_.radius[i]};
  }
}

void ExplicitStepper::store() {
  for (int i = 0; i < world_.size(); ++i) {
    Body& body = bodies_[i];
    world_.x[i] = body.x[0];
    world_.y[i] = body.x[1];
    world_.vx[i] = body.v[0];
    world_.vy[i] = body.v[1];
    world_.omega[i] = body.turn[0] / world_.radius[i];
    world_.angle[i] += body.rolled / world_.radius[i];
    body.rolled = 0;
  }
}

void ExplicitStepper::add_loads() {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    bodies_[i].force += loads_[i].force;
    bodies_[i].t += loads_[i].t;
  }
}

void ExplicitStepper::place_springs(const std::vector<ContactState>& contacts) {
  pairs_.clear();
  wall_pairs_.clear();
  springs_.clear();
  wall_springs_.clear();
  lever_pairs_.clear();
  auto contact = contacts.begin();
  const auto spring_of = [&](int a, int b) {
    if (contact == contacts.end() || contact->a != a || contact->b != b) return 0.0;
    return (contact++)->spring;
  };
  const int n = world_.size();
  for (int i = 0; i < n; ++i) {
    for (const int w : neighbours_.walls_near(i)) {
      wall_pairs_.push_back({i, w, world_.arms_of(i, -w - 1).a});
      wall_springs_.push_back(spring_of(i, -w - 1));
    }
    for (const int j : neighbours_.disks_near(i)) {
      if (const Arms arms = world_.arms_of(i, j); arms != Arms{}) {
        lever_pairs_.push_back({i, j, arms, spring_of(i, j)});
        continue;
      }
      pairs_.push_back({&bodies_[i], &bodies_[j]});
      springs_.push_back(spring_of(i, j));
    }
  }
  if (pairs_.size() % 2 == 1) {
    pairs_.push_back({&bodies_[n], &bodies_[n + 1]});
    springs_.push_back(0);
  }
}

void ExplicitStepper::refresh_neighbours() {
  // Not the angles: the sums behind them must not depend on when lists are made.
  for (int i = 0; i < world_.size(); ++i) {
    world_.x[i] = bodies_[i].x[0];
    world_.y[i] = bodies_[i].x[1];
    world_.vx[i] = bodies_[i].v[0];
    world_.vy[i] = bodies_[i].v[1];
  }
  path_ = neighbours_.farthest_move(world_);
  if (path_ <= neighbours_.skin() / 2) return;
  const std::vector<ContactState> touching = state();
  neighbours_.set_skin(suitable_skin());
  neighbours_.rebuild(world_, 0);
  place_springs(touching);
  path_ = 0;
}

std::vector<ContactState> ExplicitStepper::state() const {
  std::vector<ContactState> contacts;
  std::size_t next = 0;
  std::size_t next_wall = 0;
  std::size_t next_lever = 0;
  for (int i = 0; i < world_.size(); ++i) {
    for (; next_wall < wall_pairs_.size() && wall_pairs_[next_wall].disk == i; ++next_wall) {
      contacts.push_back({.a = i,
                          .b = -wall_pairs_[next_wall].wall - 1,
                          .mu = world_.friction.wall,
                          .spring = wall_springs_[next_wall]});
    }
    const auto first_of_disk = static_cast<std::ptrdiff_t>(contacts.size());
    for (; next < pairs_.size() && pairs_[next].a == &bodies_[i]; ++next) {
      contacts.push_back({.a = i,
                          .b = static_cast<int>(pairs_[next].b - bodies_.data()),
                          .mu = world_.friction.disk,
                          .spring = springs_[next]});
    }
    if (next_lever == lever_pairs_.size() || lever_pairs_[next_lever].a != i) continue;
    for (; next_lever < lever_pairs_.size() && lever_pairs_[next_lever].a == i; ++next_lever) {
      contacts.push_back({.a = i,
                          .b = lever_pairs_[next_lever].b,
                          .mu = world_.friction.disk,
                          .spring = lever_pairs_[next_lever].spring});
    }
    std::sort(contacts.begin() + first_of_disk, contacts.end(),
              [](const ContactState& p, const ContactState& q) { return p.b < q.b; });
  }
  return elastic_forces(world_, contacts, law_.k);
}

std::vector<ContactState> ExplicitStepper::forces() const { return state(); }

template <bool kFriction>
void ExplicitStepper::add_wall_forces() {
  const SpringLaw law = law_;
  for (std::size_t k = 0; k < wall_pairs_.size(); ++k) {
    const Wall& wall = world_.walls[wall_pairs_[k].wall];
    Body& a = bodies_[wall_pairs_[k].disk];
    const double nx = wall.normal.x();
    const double ny = wall.normal.y();
    const double gap = (a.x[0] - wall.point.x()) * nx + (a.x[1] - wall.point.y()) * ny - a.turn[1];
    if (gap >= 0) {
      wall_springs_[k] = 0;
      continue;
    }
    const double R = law.normal_force(gap, nx * a.v[0] + ny * a.v[1]);
    a.force += Lanes{R * nx, R * ny};
    if constexpr (kFriction) {
      const double arm = wall_pairs_[k].arm;
      const double u_t = ny * a.v[0] - nx * a.v[1] + arm * a.turn[0];
      const auto [T, spring, sliding] =
          law.tangential_force(wall_springs_[k] + dt_ * u_t, u_t, world_.friction.wall * R);
      wall_springs_[k] = spring;
      a.force += Lanes{T * ny, -T * nx};
      a.t += arm * T;
    }
  }
}

template <bool kFriction>
void ExplicitStepper::add_lever_pair_forces() {
  const SpringLaw law = law_;
  for (LeverPair& pair : lever_pairs_) {
    Body& a = bodies_[pair.a];
    Body& b = bodies_[pair.b];
    const Lanes apart = a.x - b.x;
    const double distance = std::sqrt(apart[0] * apart[0] + apart[1] * apart[1]);
    const double gap = distance - (a.turn[1] + b.turn[1]);
    if (gap >= 0) {
      pair.spring = 0;
      continue;
    }
    const double nx = apart[0] / distance;
    const double ny = apart[1] / distance;
    const Lanes u = a.v - b.v;
    const double R = law.normal_force(gap, nx * u[0] + ny * u[1]);
    Lanes force{R * nx, R * ny};
    if constexpr (kFriction) {
      const double u_t = ny * u[0] - nx * u[1] + pair.arms.a * a.turn[0] + pair.arms.b * b.turn[0];
      const auto [T, spring, sliding] =
          law.tangential_force(pair.spring + dt_ * u_t, u_t, world_.friction.disk * R);
      pair.spring = spring;
      force += Lanes{T * ny, -T * nx};
      a.t += pair.arms.a * T;
      b.t += pair.arms.b * T;
    }
    a.force += force;
    b.force -= force;
  }
}

/// The law of force_law.h for two pairs at a time and without branches: which pairs touch and which slide
/// changes from pair to pair, so that a processor could not guess it.
template <bool kFriction>
void ExplicitStepper::add_pair_forces() {
  const Lanes zero = both(0);
  const Lanes k = both(law_.k);
  const Lanes gamma = both(law_.gamma);
  const Lanes per_k = both(1 / law_.k);
  const Lanes mu = both(world_.friction.disk);
  const Lanes dt = both(dt_);
  double* springs = springs_.data();
  const Pair* pairs = pairs_.data();
  const std::size_t count = pairs_.size();
  for (std::size_t p = 0; p < count; p += 2) {
    Body& a0 = *pairs[p].a;
    Body& b0 = *pairs[p].b;
    Body& a1 = *pairs[p + 1].a;
    Body& b1 = *pairs[p + 1].b;
    const Lanes d0 = a0.x - b0.x;
    const Lanes d1 = a1.x - b1.x;
    const Lanes dx = first_of(d0, d1);
    const Lanes dy = second_of(d0, d1);
    const Lanes turn0 = a0.turn + b0.turn;
    const Lanes turn1 = a1.turn + b1.turn;
    const Lanes distance = root(dx * dx + dy * dy);
    const Lanes gap = distance - second_of(turn0, turn1);
    const LaneMask touching = gap < zero;
    const Lanes inverse = both(1) / distance;
    const Lanes nx = dx * inverse;
    const Lanes ny = dy * inverse;
    const Lanes u0 = a0.v - b0.v;
    const Lanes u1 = a1.v - b1.v;
    const Lanes ux = first_of(u0, u1);
    const Lanes uy = second_of(u0, u1);
    const Lanes R = where(touching, larger(-k * gap - gamma * (nx * ux + ny * uy), zero));
    Lanes fx = R * nx;
    Lanes fy = R * ny;
    if constexpr (kFriction) {
      const Lanes u_t = ny * ux - nx * uy + first_of(turn0, turn1);
      const Lanes stretch = Lanes{springs[p], springs[p + 1]} + dt * u_t;
      const Lanes limit = mu * R;
      const Lanes trial = -k * stretch - gamma * u_t;
      const Lanes T = smaller(larger(trial, -limit), limit);
      const Lanes spring = where(touching, T == trial ? stretch : -T * per_k);
      springs[p] = spring[0];
      springs[p + 1] = spring[1];
      fx += T * ny;
      fy -= T * nx;
      a0.t += T[0];
      b0.t += T[0];
      a1.t += T[1];
      b1.t += T[1];
    }
    const Lanes f0 = first_of(fx, fy);
    const Lanes f1 = second_of(fx, fy);
    a0.force += f0;
    b0.force -= f0;
    a1.force += f1;
    b1.force -= f1;
  }
}

template <bool kFriction, bool kHeld>
double ExplicitStepper::move() {
  const double dt = dt_;
  const Lanes fall = fall_;
  double fastest = 0;
  const Body* end = bodies_.data() + world_.size();
  for (Body* body = bodies_.data(); body != end; ++body) {
    if constexpr (kHeld) {
      if (body->per_force == 0) {
        body->force = both(0);
        body->t = 0;
        continue;
      }
    }
    body->v += fall + body->per_force * body->force;
    body->x += dt * body->v;
    body->force = both(0);
    if constexpr (kFriction) {
      body->turn[0] += body->per_torque * body->t;
      body->rolled += dt * body->turn[0];
      body->t = 0;
    }
    const Lanes squares = body->v * body->v;
    fastest = std::max(fastest, squares[0] + squares[1]);
  }
  return fastest;
}

template <bool kFriction>
void ExplicitStepper::advance_as(int steps) {
  for (int i = 0; i < steps; ++i) {
    if (path_ > neighbours_.skin() / 2) refresh_neighbours();
    add_loads();
    add_wall_forces<kFriction>();
    add_pair_forces<kFriction>();
    add_lever_pair_forces<kFriction>();
    path_ += dt_ * std::sqrt(held_ ? move<kFriction, true>() : move<kFriction, false>());
  }
}

void ExplicitStepper::advance(int steps) {
  load();
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
  const double arm = world.largest_arm();
  double factor = 0;
  for (int i = 0; i < world.size(); ++i) {
    if (world.fixed[i]) continue;
    const double around = std::floor(std::numbers::pi / std::asin(smallest / (world.radius[i] + smallest)) +
                                     tolerance::kWholeNumber);
    double response = 1 / world.mass[i];
    if (world.friction.any())
      response = std::max(response, arm * arm * world.radius[i] * world.radius[i] / world.inertia[i]);
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
