#include "apps/simulate_tilt.h"

#include <fmt/format.h>

#include <chrono>
#include <initializer_list>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/bridge/simulation_values.h"
#include "apps/output_files.h"
#include "apps/say.h"
#include "apps/simulate_report.h"
#include "apps/simulate_start.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libsim/tilt.h"

namespace indet::app {
namespace {

sim::TiltOptions tilt_options_of(const SimulateOptions& o) {
  constexpr double kDegree = std::numbers::pi / 180;
  return {.rate = *o.tilt_rate * kDegree,
          .angle_limit = o.tilt_limit * kDegree,
          .most_moved = o.tilt_moved,
          .distance = o.tilt_distance,
          .row_interval = o.tilt_every * kDegree};
}

}  // namespace

void refuse_tilt_options_without_effect(const SimulateOptions& o, const CLI::App& command) {
  const auto refuse = [&](std::initializer_list<const char*> names, const char* why) {
    for (const char* name : names) {
      if (command.count(name) > 0) throw InputError(fmt::format("{} has no effect {}", name, why));
    }
  };
  if (!o.tilts()) {
    refuse({"--tilt-limit", "--tilt-moved", "--tilt-distance", "--tilt-every"}, "without --tilt-rate");
    return;
  }
  if (o.from.empty()) throw InputError("--tilt-rate tilts a packing that is there: name its file by --from");
  refuse({"--resume", "--checkpoint"}, "together with --tilt-rate: a tilt makes no checkpoints");
}

int run_tilt(const SimulateOptions& o, const CLI::App& command, const Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  claim_output(o.output, FileKind::kPacking, replacement_rule({o.from}, o.overwrite, context));
  const bool rigid = is_simulated_by(o.protocol(), sim::Simulator::kContactDynamics);
  const SimulationStart start = start_of(o, command, context);
  sim::SimulationOptions options = simulation_options_of(o, rigid, command);
  options.time_limit =
      o.time_limit.value_or(start.height > 0 ? sim::default_time_limit(start.world, start.height) : 0);
  const sim::TiltOptions how = tilt_options_of(o);

  Trajectory trajectory;
  sim::Listener listener;
  listener.progress = context.progress();
  listener.frame_interval = o.every;
  listener.on_frame = [&](const sim::Frame& frame) { trajectory.push_back(frame_of(frame, start.world)); };
  const sim::Tilt tilt = sim::tilt(*start.packing, start.world.friction, options, how, listener);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  Packing packing = tilt.rest.packing;
  packing.origin = {
      .protocol = o.protocol_name,
      .seed = start.seed,
      .config = start.description + to_toml(options) + to_toml(how) + fmt::format("every = {}\n", o.every),
      .width = start.width,
      .height = start.height};
  SimulationRecord record = record_of(tilt.rest, options);
  record.tilt = record_of(tilt, how, start.world);
  Provenance provenance{context.arguments, context.resolved_config, {}, {}};
  provenance.seconds["simulate"] = seconds;
  write_simulation(o.output, packing, record, trajectory, provenance);

  if (context.json) {
    nlohmann::json json = simulation_to_json(o, packing, record, seconds);
    json["tilt"] = tilt_to_json(packing, tilt, *record.tilt);
    std::cout << json.dump(2) << '\n';
  } else if (context.prints_report()) {
    print_tilt_report(o, packing, tilt, seconds);
    say("written to {}\n", o.output);
  }
  if (tilt.start_distance > tolerance::kOtherForces) {
    context.warn(fmt::format(
        "{}: its forces changed by {:.2g} mg while it came to rest before gravity turned: tilt a packing by "
        "the simulator that made it, with the same options",
        o.from, tilt.start_distance));
  }
  if (tilt.rest.polished.balanced) return kDone;
  context.warn(fmt::format("{}: the forces do not balance: {}", o.output, tilt.rest.polished.reason));
  return kUncertain;
}

}  // namespace indet::app
