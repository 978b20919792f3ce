#include "libsim/tilt.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/packing/loads.h"
#include "libsim/contact_memory.h"

namespace indet::sim {
namespace {

using Clock = std::chrono::steady_clock;

/// States that are kept to go back to: those of so many rows before the end.
constexpr std::size_t kKeptStates = 64;
constexpr double kMostSteps = 1e12;

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

/// How far disks are from where they were.
class Displacements {
 public:
  explicit Displacements(const World& world) : x_(world.x), y_(world.y) {}

  double square(const World& world, int disk) const {
    const double dx = world.x[disk] - x_[disk];
    const double dy = world.y[disk] - y_[disk];
    return dx * dx + dy * dy;
  }
  int farthest(const World& world) const {
    int result = 0;
    for (int i = 1; i < world.size(); ++i) {
      if (square(world, i) > square(world, result)) result = i;
    }
    return result;
  }
  double largest(const World& world) const { return std::sqrt(square(world, farthest(world))); }
  int count_beyond(const World& world, double distance) const {
    int count = 0;
    for (int i = 0; i < world.size(); ++i) count += square(world, i) > distance * distance ? 1 : 0;
    return count;
  }

 private:
  std::vector<double> x_, y_;
};

/// A state to go on from, as in a checkpoint.
struct Kept {
  double angle = 0;
  World world;
  std::vector<ContactState> contacts;
};

class Tilting {
 public:
  Tilting(const Packing& packing, const Friction& friction, const SimulationOptions& options,
          const TiltOptions& how, const Listener& listener);
  Tilt run();

 private:
  void come_to_rest();
  void turn();
  void note_moved(double angle);
  void add_row(double angle);
  void keep(double angle);
  void go_back_to_rest();
  bool is_over() const { return tilt_.moved >= how_.most_moved; }

  const Packing& packing_;
  const SimulationOptions& options_;
  const TiltOptions& how_;
  const Listener& listener_;
  World start_;
  Units units_;
  double distance_ = 0;  ///< Scene's unit.
  std::unique_ptr<Stepper> stepper_;
  std::optional<Displacements> displacements_;
  std::deque<Kept> kept_;
  Tilt tilt_;
};

Tilting::Tilting(const Packing& packing, const Friction& friction, const SimulationOptions& options,
                 const TiltOptions& how, const Listener& listener)
    : packing_(packing),
      options_(options),
      how_(how),
      listener_(listener),
      start_(world_of(packing, friction)) {
  start_.bring_to_rest();
  if (const auto reason = options.defect(start_)) throw InputError(*reason);
  if (const auto reason = how.defect(start_)) throw InputError(*reason);
  units_ = start_.units();
  distance_ = how.distance * units_.length;
  stepper_ = make_stepper(start_, contact_memory(packing, units_, options), options);
}

Tilt Tilting::run() {
  come_to_rest();
  turn();
  go_back_to_rest();
  return std::move(tilt_);
}

void Tilting::come_to_rest() {
  const Displacements displacements(start_);
  const Settled settled =
      settle(*stepper_, stop_criteria(options_), stride_of(options_), {.progress = listener_.progress});
  const int disk = displacements.farthest(stepper_->world());
  const double moved = displacements.largest(stepper_->world());
  const char* advice = "; tilt a packing by the simulator that made it, with the same options";
  if (moved > distance_) {
    throw InputError(fmt::format(
        "the packing does not stand in {} as it is: disk {} moves by {:.3g} r_max before gravity turns{}",
        to_string(options_.simulator), start_.id[disk], moved / units_.length, advice));
  }
  if (settled.ending != Ending::kStatic) {
    throw InputError(
        fmt::format("the packing does not come to rest before gravity turns ({}){}", settled.reason, advice));
  }
  tilt_.start_distance = force_distance(packing_, stepper_->forces());
  start_ = stepper_->world();
  displacements_.emplace(start_);
  tilt_.moved_at.assign(start_.size(), std::numeric_limits<double>::quiet_NaN());
}

void Tilting::turn() {
  const double dt = stepper_->dt() / units_.time;
  const int stride = stride_of(options_);
  const double speed = std::abs(how_.rate);
  const double sign = how_.rate < 0 ? -1 : 1;
  const StepperReport before = stepper_->report();
  const double needed = std::ceil(how_.angle_limit / (speed * dt));
  if (!(needed < kMostSteps)) {
    throw InputError(fmt::format("at this rate the limit of the tilt is {:.1g} time steps away", needed));
  }
  const auto all_steps = static_cast<std::int64_t>(needed);
  const std::int64_t frame_strides =
      listener_.frame_interval > 0
          ? std::max<std::int64_t>(1, std::llround(listener_.frame_interval / (dt * stride)))
          : 0;
  auto last_progress = Clock::now();
  std::int64_t rows = 0;
  double angle = 0;
  for (std::int64_t steps = 0;; steps += stride) {
    // The angle at this moment; gravity stays so for one stride.
    angle = steps == 0 ? 0 : sign * std::min(speed * static_cast<double>(steps) * dt, how_.angle_limit);
    if (!std::isfinite(stepper_->world().kinetic_energy()))
      throw LibraryError(
          fmt::format("the simulation diverged at {:.4g}°: velocities are no longer finite", degrees(angle)));
    note_moved(angle);
    const bool is_last = is_over() || steps >= all_steps;
    if (is_last || std::abs(angle) >= static_cast<double>(rows) * how_.row_interval) {
      rows = static_cast<std::int64_t>(std::abs(angle) / how_.row_interval) + 1;
      add_row(angle);
      if (!is_over()) keep(angle);
    }
    if (frame_strides > 0 && (is_last || (steps / stride) % frame_strides == 0))
      listener_.on_frame(frame_of(*stepper_, static_cast<double>(steps) * dt));
    if (is_last) break;
    if (listener_.progress &&
        std::chrono::duration<double>(Clock::now() - last_progress).count() > kProgressSeconds) {
      last_progress = Clock::now();
      const std::string details =
          fmt::format("{:.3f}°, kinetic energy {:.1e}, disks move by up to {:.1e} r_max", degrees(angle),
                      stepper_->world().kinetic_energy() / units_.energy() / start_.free_size(),
                      displacements_->largest(stepper_->world()) / units_.length);
      if (!listener_.progress({"tilt", steps, all_steps, details})) throw Interrupted();
    }
    stepper_->set_gravity(turned(start_.gravity, angle));
    stepper_->advance(stride);
  }
  tilt_.report = stepper_->report();
  tilt_.report.steps -= before.steps;
  tilt_.report.capped_steps -= before.capped_steps;
  tilt_.report.sweeps -= before.sweeps;
  tilt_.report.contact_updates -= before.contact_updates;
}

void Tilting::note_moved(double angle) {
  const World& world = stepper_->world();
  for (int i = 0; i < world.size(); ++i) {
    if (!std::isnan(tilt_.moved_at[i]) || displacements_->square(world, i) <= distance_ * distance_) continue;
    tilt_.moved_at[i] = angle;
    ++tilt_.moved;
  }
}

void Tilting::add_row(double angle) {
  TiltRow row{.angle = angle};
  const bool rigid = options_.simulator == Simulator::kContactDynamics;
  const double epsilon =
      units_.force * (rigid ? tolerance::kSliding
                            : std::max(tolerance::kSliding, 10 * options_.molecular_dynamics.residual));
  for (const ContactState& contact : stepper_->state()) {
    if (contact.R < epsilon) continue;
    ++row.contacts;
    if (contact.mu > 0 && contact.mu * contact.R - std::abs(contact.T) < epsilon) ++row.sliding;
  }
  row.kinetic_energy = stepper_->world().kinetic_energy() / units_.energy() / start_.free_size();
  row.displacement = displacements_->largest(stepper_->world()) / units_.length;
  tilt_.rows.push_back(row);
}

void Tilting::keep(double angle) {
  kept_.push_back({angle, stepper_->world(), stepper_->state()});
  kept_.back().world.gravity = turned(start_.gravity, angle);
  // The first one, which is at rest, stays.
  if (kept_.size() > kKeptStates) kept_.erase(kept_.begin() + 1);
}

void Tilting::go_back_to_rest() {
  for (; !kept_.empty(); kept_.pop_back()) {
    const Kept& kept = kept_.back();
    stepper_ = make_stepper(kept.world, kept.contacts, options_);
    Settled settled =
        settle(*stepper_, stop_criteria(options_), stride_of(options_), {.progress = listener_.progress});
    const int moved = displacements_->count_beyond(stepper_->world(), distance_);
    if (kept_.size() > 1 && (settled.ending != Ending::kStatic || moved >= how_.most_moved)) continue;
    settled.reason = fmt::format("gravity held at {:.4g}°: {}", degrees(kept.angle), settled.reason);
    tilt_.rest = conclude(*stepper_, settled, options_);
    // Just beyond the limit, disks may be too slow to be told from disks at rest.
    if (kept_.size() > 1 && !tilt_.rest.polished.balanced) continue;
    tilt_.rest_angle = kept.angle;
    return;
  }
}

}  // namespace

std::optional<std::string> TiltOptions::defect(const World& world) const {
  if (world.gravity.isZero(0)) return "gravity is turned, and there is none";
  if (!std::isfinite(rate) || rate == 0) return fmt::format("the rate of the tilt must not be {}", rate);
  if (!(angle_limit > 0)) return "the limit of the angle must be positive";
  if (most_moved < 1 || most_moved > world.free_size())
    return fmt::format("{} of {} disks that can move cannot have moved", most_moved, world.free_size());
  if (!(distance > 0))
    return fmt::format("the distance that counts as moved must be positive, but is {}", distance);
  if (!(row_interval > 0)) return "the interval of angle between rows must be positive";
  return {};
}

Tilt tilt(const Packing& packing, const Friction& friction, const SimulationOptions& options,
          const TiltOptions& how, const Listener& listener) {
  return Tilting(packing, friction, options, how, listener).run();
}

}  // namespace indet::sim
