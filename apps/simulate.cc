#include "libsim/simulate.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/bridge/simulation_values.h"
#include "apps/command.h"
#include "apps/interruption.h"
#include "apps/numbers.h"
#include "apps/output_files.h"
#include "apps/say.h"
#include "apps/simulate_arguments.h"
#include "apps/simulate_report.h"
#include "apps/simulate_start.h"
#include "apps/simulate_tilt.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/io/destination.h"
#include "libindet/io/simulation_file.h"

namespace indet::app {
namespace {

std::filesystem::path checkpoint_path_of(const SimulateOptions& o) { return o.output + ".checkpoint"; }

/// Returns whether checkpoints can be written beside the output.
bool claim_outputs(const SimulateOptions& o, const Context& context) {
  const Replacement rule = replacement_rule({o.scene_file, o.from}, o.overwrite, context);
  claim_output(o.output, FileKind::kPacking, rule);
  if (destination_of(o.output).is_stream) return false;
  rule.require(checkpoint_path_of(o), FileKind::kCheckpoint);
  return true;
}

int run(const SimulateOptions& o, const CLI::App& command, const Context& context) {
  refuse_tilt_options_without_effect(o, command);
  if (o.tilts()) return run_tilt(o, command, context);
  const auto begin = std::chrono::steady_clock::now();
  const bool has_checkpoints = claim_outputs(o, context);
  const bool rigid = is_simulated_by(o.protocol(), sim::Simulator::kContactDynamics);
  const SimulationStart start = start_of(o, command, context);
  sim::SimulationOptions options = simulation_options_of(o, rigid, command);
  options.time_limit =
      o.time_limit.value_or(start.height > 0 ? sim::default_time_limit(start.world, start.height) : 0);
  if (const auto reason = options.defect(start.world)) throw InputError(*reason);

  const std::filesystem::path checkpoint_path = checkpoint_path_of(o);
  const std::string fingerprint = start.description + to_toml(options) + fmt::format("every = {}\n", o.every);
  const Provenance about{context.arguments, context.resolved_config, {}, {}};
  Trajectory trajectory;
  std::optional<sim::Checkpoint> resume;
  if (o.resume && has_checkpoints && std::filesystem::exists(checkpoint_path)) {
    const StoredCheckpoint checkpoint = read_checkpoint(open_on_trial(checkpoint_path));
    if (checkpoint.fingerprint != fingerprint) {
      throw InputError(fmt::format("{} is from a run with other options; delete it, or run without --resume",
                                   checkpoint_path.string()));
    }
    resume = loaded(checkpoint, start.world);
    trajectory = checkpoint.trajectory;
    context.note("resuming after " + counted(resume->report.steps, "step"));
  }
  sim::Listener listener;
  listener.progress = context.progress();
  listener.frame_interval = o.every;
  listener.on_frame = [&](const sim::Frame& frame) { trajectory.push_back(frame_of(frame, start.world)); };
  listener.checkpoint_seconds = has_checkpoints ? o.checkpoint : 0;
  listener.on_checkpoint = [&](const sim::Checkpoint& checkpoint) {
    write_checkpoint(checkpoint_path, stored(checkpoint, fingerprint, trajectory), about);
    const std::string text =
        fmt::format("checkpoint written to {}; --resume goes on from there", checkpoint_path.string());
    set_remains(text);
    context.note(text);
  };
  // How long a start from rest takes, and a step without implicit damping, was not measured.
  const bool is_usual = rigid || (o.preset != "stiff" && o.damping_method != "explicit");
  const bool falls = o.from.empty() && !starts_from_cd1(o.protocol());
  if (falls && is_usual && !resume)
    note_time(properties_of(o.protocol()).simulator.value(), start.world.size(), context);
  std::optional<CheckpointTime> checkpoint_time;
  if (has_checkpoints) checkpoint_time.emplace();
  const sim::Simulation result =
      sim::simulate(start.world, {}, options, listener, resume ? &*resume : nullptr);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  Packing packing = result.packing;
  packing.origin = {.protocol = o.protocol_name,
                    .seed = start.seed,
                    .config = fingerprint,
                    .width = start.width,
                    .height = start.height};
  const SimulationRecord record = record_of(result, options);
  Provenance provenance = about;
  provenance.seconds["simulate"] = seconds;
  write_simulation(o.output, packing, record, trajectory, provenance);
  set_written();
  checkpoint_time.reset();
  if (has_checkpoints) std::filesystem::remove(checkpoint_path);

  if (context.json) {
    std::cout << simulation_to_json(o, packing, record, seconds).dump(2) << '\n';
  } else if (context.prints_report()) {
    print_simulation_report(packing, result, seconds);
    say("written to {}\n", o.output);
  }
  if (result.polished.balanced) return kDone;
  context.warn(fmt::format("{}: the forces do not balance: {}", o.output, result.polished.reason));
  return kUncertain;
}

}  // namespace

Command add_simulate(CLI::App& root) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = root.add_subcommand("simulate", "Make a packing: let disks fall and come to rest");
  command
      ->add_option(
          "--protocol", options->protocol_name,
          "cd: contact dynamics, md: molecular dynamics; cd1, md1: disks fall from a grid; cd2, md2: "
          "start at rest from the positions of a cd1 packing")
      ->required()
      ->check(CLI::IsMember(sim::simulated_names()));
  command->add_option("--seed", options->seed, "Seed of the random radii and positions (default: 0)");
  command->add_option("--from", options->from, "HDF5 file of the packing to start from")
      ->check(CLI::ExistingFile);
  command->add_option("-o,--output", options->output, "HDF5 file to write")->required();
  add_overwrite_option(*command, options->overwrite);
  command
      ->add_option("--every", options->every,
                   "Store the trajectory, a frame at each such interval of simulated time")
      ->check(not_negative());
  command
      ->add_option("--checkpoint", options->checkpoint, "Seconds of run time between checkpoints (0: none)")
      ->check(not_negative())
      ->capture_default_str();
  command->add_flag("--resume", options->resume,
                    "Go on from the checkpoint of an interrupted run, OUTPUT.checkpoint, if there is one");
  add_scene_options(*command, *options);
  add_method_options(*command, *options);
  add_tilt_options(*command, *options);
  return {command, [options, command](const Context& context) { return run(*options, *command, context); }};
}

}  // namespace indet::app
