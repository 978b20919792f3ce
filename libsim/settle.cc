#include "libsim/settle.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "libindet/base/error.h"

namespace indet::sim {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

StepperReport sum(const StepperReport& before, const StepperReport& now) {
  StepperReport total = now;
  total.steps += before.steps;
  total.capped_steps += before.capped_steps;
  total.sweeps += before.sweeps;
  total.contact_updates += before.contact_updates;
  return total;
}

/// Which disk keeps the state from being static.
std::string describe_motion(const World& world, const Settled& settled) {
  const Units units = world.units();
  int fastest = 0;
  double speed = -1;
  for (int i = 0; i < world.size(); ++i) {
    const double s = std::hypot(world.vx[i], world.vy[i]);
    if (s > speed) {
      speed = s;
      fastest = i;
    }
  }
  return fmt::format(
      "not at rest at the time limit, {:.4g}: kinetic energy per disk {:.2e}, forces balance to {:.2e} mg; "
      "disk {} moves fastest, at ({:.4g}, {:.4g}) with speed {:.2e}",
      settled.time, settled.kinetic_energy, settled.residual, world.id[fastest],
      world.x[fastest] / units.length, world.y[fastest] / units.length, speed / units.speed());
}

}  // namespace

Frame frame_of(const Stepper& stepper, double time) {
  const World& world = stepper.world();
  return {.time = time,
          .x = world.x,
          .y = world.y,
          .angle = world.angle,
          .vx = world.vx,
          .vy = world.vy,
          .omega = world.omega,
          .contacts = stepper.forces()};
}

Settled settle(Stepper& stepper, const StopCriteria& criteria, int stride, const Listener& listener,
               const Checkpoint* start) {
  const Units units = stepper.world().units();
  const double dt = stepper.dt() / units.time;
  const double energy_limit =
      criteria.kinetic_energy * units.energy() * std::max(1, stepper.world().free_size());
  const StepperReport before = start ? start->report : StepperReport{};
  const auto all_steps = static_cast<std::int64_t>(std::ceil(criteria.time_limit / dt));
  const auto per_check = dt * stride;
  const std::int64_t frame_checks =
      listener.frame_interval > 0
          ? std::max<std::int64_t>(1, std::llround(listener.frame_interval / per_check))
          : 0;
  Settled result;
  int calm = start ? start->calm_steps : 0;
  auto last_progress = Clock::now();
  auto last_checkpoint = last_progress;

  const auto checkpoint = [&] {
    if (!listener.on_checkpoint) return;
    listener.on_checkpoint({stepper.world(), stepper.state(), sum(before, stepper.report()), calm});
  };
  if (frame_checks > 0 && before.steps == 0) listener.on_frame(frame_of(stepper, 0));
  while (before.steps + stepper.report().steps < all_steps) {
    stepper.advance(stride);
    const std::int64_t steps = before.steps + stepper.report().steps;
    result.time = static_cast<double>(steps) * dt;
    const double energy = stepper.world().kinetic_energy();
    if (!std::isfinite(energy)) {
      throw LibraryError(fmt::format(
          "the simulation diverged at time {:.4g}: velocities are no longer finite", result.time));
    }
    bool is_calm = energy < energy_limit;
    if (is_calm) {
      result.residual = imbalance_of(stepper.world(), stepper.forces()).worst();
      is_calm = result.residual < criteria.residual;
    }
    calm = is_calm ? calm + stride : 0;
    if (frame_checks > 0 && (steps / stride) % frame_checks == 0)
      listener.on_frame(frame_of(stepper, result.time));
    if (calm > criteria.calm_steps) {
      result.ending = Ending::kStatic;
      break;
    }
    if (listener.progress && seconds_since(last_progress) > kProgressSeconds) {
      last_progress = Clock::now();
      const std::vector<ContactState> contacts = stepper.forces();
      const std::string details =
          fmt::format("t = {:.2f}, kinetic energy {:.1e}, {} contacts, residual {:.1e}", result.time,
                      energy / units.energy() / stepper.world().free_size(), contacts.size(),
                      imbalance_of(stepper.world(), contacts).worst());
      if (!listener.progress({"simulate", steps, all_steps, details})) {
        checkpoint();
        throw Interrupted();
      }
    }
    if (listener.checkpoint_seconds > 0 && seconds_since(last_checkpoint) > listener.checkpoint_seconds) {
      checkpoint();
      last_checkpoint = Clock::now();
    }
  }
  result.report = sum(before, stepper.report());
  result.kinetic_energy =
      stepper.world().kinetic_energy() / units.energy() / std::max(1, stepper.world().free_size());
  const std::vector<ContactState> contacts = stepper.forces();
  result.report.contacts = static_cast<int>(contacts.size());
  result.residual = imbalance_of(stepper.world(), contacts).worst();
  result.reason =
      result.ending == Ending::kStatic
          ? fmt::format("at rest at time {:.4g}: forces balance to {:.1e} mg", result.time, result.residual)
          : describe_motion(stepper.world(), result);
  return result;
}

}  // namespace indet::sim
