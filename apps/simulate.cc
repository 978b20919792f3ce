#include "libsim/simulate.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/bridge/simulation_values.h"
#include "apps/command.h"
#include "apps/interruption.h"
#include "apps/memory_limit.h"
#include "apps/numbers.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "apps/simulate_arguments.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/base/toml_text.h"
#include "libindet/io/destination.h"
#include "libindet/io/simulation_file.h"
#include "libsim/memory_estimate.h"
#include "libsim/molecular_preset.h"
#include "libsim/scene_toml.h"
#include "libsim/time_estimate.h"

namespace indet::app {
namespace {

using sim::Scene;
using sim::SimulationOptions;

template <class T, class U>
void set(T& target, const std::optional<U>& given) {
  if (given) target = *given;
}

Scene scene_of(const SimulateOptions& o) {
  Scene scene = o.scene_file.empty() ? Scene{} : sim::read_scene(o.scene_file);
  set(scene.seed, o.seed);
  set(scene.disks, o.disks);
  set(scene.columns, o.columns);
  if (!o.radius.empty()) {
    scene.radius_min = o.radius[0];
    scene.radius_max = o.radius[1];
  }
  if (!o.gravity.empty()) scene.gravity = {o.gravity[0], o.gravity[1]};
  set(scene.density, o.density);
  set(scene.friction.disk, o.mu);
  set(scene.friction.wall, o.mu);
  set(scene.friction.wall, o.wall_mu);
  set(scene.force_unit, o.force_unit);
  set(scene.width, o.width);
  set(scene.height, o.height);
  set(scene.funnel_angle, o.funnel_angle);
  set(scene.jitter, o.jitter);
  if (!o.container.empty()) scene.container = sim::container_from(o.container);
  return scene;
}

/// Options that shape the first state have no effect on one that is read.
void refuse_scene_options(const CLI::App& command) {
  for (const char* name : {"--scene", "--disks", "--columns", "--radius", "--gravity", "--density",
                           "--force-unit", "--width", "--funnel-angle", "--jitter", "--container"}) {
    if (command.count(name) > 0) {
      throw InputError(
          fmt::format("{} has no effect together with --from: the scene is that of the packing there", name));
    }
  }
}

SimulationOptions simulation_options_of(const SimulateOptions& o, bool rigid, const CLI::App& command) {
  SimulationOptions options;
  const auto refuse = [&](const char* name, const char* where) {
    if (command.count(name) > 0)
      throw InputError(
          fmt::format("{} has no effect with --protocol {}: it is for {}", name, o.protocol_name, where));
  };
  if (rigid) {
    for (const char* name : {"--preset", "--stiffness", "--damping", "--damping-method"})
      refuse(name, "md1 and md2");
    sim::ContactDynamicsOptions& cd = options.contact_dynamics;
    set(cd.dt, o.dt);
    set(cd.tolerance, o.tolerance);
    set(cd.max_sweeps, o.sweeps);
    set(cd.start_sweeps, o.start_sweeps);
    set(cd.law.alpha, o.alpha);
    set(cd.law.restitution_n, o.restitution);
    set(cd.law.restitution_t, o.tangential_restitution);
    set(cd.residual, o.residual);
  } else {
    for (const char* name : {"--start-sweeps", "--alpha", "--restitution", "--tangential-restitution"})
      refuse(name, "cd1 and cd2");
    options.simulator = sim::Simulator::kMolecularDynamics;
    sim::MolecularDynamicsOptions& md = options.molecular_dynamics;
    md = options_of(sim::molecular_preset_from(o.preset).value());
    set(md.k, o.stiffness);
    set(md.gamma, o.damping);
    set(md.dt, o.dt);
    set(md.tolerance, o.tolerance);
    set(md.max_sweeps, o.sweeps);
    set(md.residual, o.residual);
    if (o.damping_method == "explicit") md.damping = sim::Damping::kExplicit;
    if (o.damping_method == "implicit") md.damping = sim::Damping::kImplicit;
  }
  set(options.kinetic_energy, o.kinetic_energy);
  return options;
}

void require_memory_for(std::int64_t disks) {
  require_memory(sim::memory_estimate(disks), fmt::format("a simulation of {}", counted(disks, "disk")));
}

/// What to expect of a simulation that takes long, before it begins.
void note_time(sim::Simulator simulator, std::int64_t disks, const Context& context) {
  const std::string notice = sim::time_notice(simulator, disks);
  if (!notice.empty()) context.note(notice);
}

/// The state that the protocol starts from.
struct Start {
  sim::World world;
  std::int64_t seed = 0;
  double width = 0;   ///< 0: not known.
  double height = 0;  ///< That the default time limit is reckoned from.
  std::string description;
};

Start start_of(const SimulateOptions& o, const CLI::App& command, const Context& context) {
  const bool second = starts_from_cd1(o.protocol());
  if (!o.from.empty()) {
    refuse_scene_options(command);
    const Packing packing = read_packing(open_packing(o.from));
    require_memory_for(packing.disk_count());
    const sim::Friction friction = sim::friction_of(packing, {o.mu, o.wall_mu ? o.wall_mu : o.mu});
    Start start{.world = sim::world_of(packing, friction), .seed = packing.origin.seed, .description = ""};
    if (o.seed) start.seed = static_cast<std::int64_t>(*o.seed);
    start.description = "from = " + toml_text(o.from) + "\n" + packing.origin.config;
    const Scene usual{.disks = packing.disk_count(), .radius_max = packing.max_radius()};
    start.width = packing.origin.width;
    start.height =
        o.height.value_or(packing.origin.height > 0 ? packing.origin.height : usual.resolved().height);
    if (second) start.world.bring_to_rest();
    return start;
  }
  const Scene scene = scene_of(o);
  if (const auto reason = scene.defect()) throw InputError(*reason);
  require_memory_for(scene.disks);
  const Scene resolved = scene.resolved();
  Start start{.world = sim::build(scene),
              .seed = static_cast<std::int64_t>(scene.seed),
              .width = resolved.width,
              .height = resolved.height,
              .description = sim::to_toml(resolved)};
  if (second) {
    context.note(fmt::format("{} starts from a cd1 packing, and --from names none: simulating cd1 first",
                             o.protocol_name));
    SimulationOptions first;
    first.time_limit = sim::default_time_limit(start.world, start.height);
    note_time(sim::Simulator::kContactDynamics, start.world.size(), context);
    const sim::Simulation cd1 = sim::simulate(start.world, {}, first, {.progress = context.progress()});
    start.world = sim::world_of(cd1.packing, start.world.friction);
    start.world.bring_to_rest();
    start.description += "from = \"cd1\"\n";
  }
  return start;
}

nlohmann::json to_json(const SimulateOptions& o, const Packing& packing, const SimulationRecord& record,
                       double seconds) {
  nlohmann::json json = {{"output", o.output},
                         {"protocol", packing.origin.protocol},
                         {"seed", packing.origin.seed},
                         {"disks", packing.disk_count()},
                         {"contacts", packing.contact_count()},
                         {"force_unit", packing.force_unit()},
                         {"seconds", seconds}};
  for (const auto& [name, value] : record.numbers) json[name] = value;
  for (const auto& [name, value] : record.texts) json[name] = value;
  return json;
}

void print_report(const Packing& packing, const sim::Simulation& result, double seconds) {
  const sim::Polished& polished = result.polished;
  say("{}, seed {}: {}, {}, mean R = {:.4g} mg, mean overlap {:.2e} r_max\n", packing.origin.protocol,
      packing.origin.seed, counted(packing.disk_count(), "disk"), counted(packing.contact_count(), "contact"),
      result.mean_force, result.mean_overlap);
  say("{}\n", result.settled.reason);
  say("polished forces balance to {:.2e} mg, and are {:.2e} mg away from the simulated ones\n",
      polished.residual, polished.distance);
  say("{}\n", counted(polished.sliding, "sliding contact"));
  say("{} in {:.2f} s\n", counted(result.settled.report.steps, "step"), seconds);
}

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
  const auto begin = std::chrono::steady_clock::now();
  const bool has_checkpoints = claim_outputs(o, context);
  const bool rigid = is_simulated_by(o.protocol(), sim::Simulator::kContactDynamics);
  const Start start = start_of(o, command, context);
  SimulationOptions options = simulation_options_of(o, rigid, command);
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
    std::cout << to_json(o, packing, record, seconds).dump(2) << '\n';
  } else if (context.prints_report()) {
    print_report(packing, result, seconds);
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
  return {command, [options, command](const Context& context) { return run(*options, *command, context); }};
}

}  // namespace indet::app
