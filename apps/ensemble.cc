#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/member_file.h"
#include "apps/ensemble/members/run.h"
#include "apps/ensemble_output.h"
#include "apps/interruption.h"
#include "apps/memory_limit.h"
#include "apps/numbers.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/lp/glpk_problem.h"
#include "libsim/memory_estimate.h"
#include "libsim/molecular_preset.h"
#include "libsim/scene_toml.h"
#include "libsim/time_estimate.h"

namespace indet::app {
namespace {

struct EnsembleCommand {
  std::string folder, scene_file, members, preset = "paper", uniform_seeds = "20", paper_walk = "60",
                                           limits = "60";
  std::optional<int> disks;
  std::optional<double> mu;
  EnsembleConfig config;
  std::vector<std::string> protocol_names, files;
  bool dry_run = false;
  bool overwrite = false;
  bool no_solver_states = false;
};

/// "all", or a number.
std::int64_t count_of(const char* option, const std::string& text) {
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (text == "all") return std::numeric_limits<std::int64_t>::max();
  if (error != std::errc() || end != text.data() + text.size() || count < 0)
    throw UsageError(fmt::format("{} {}: expected a number, or all", option, excerpt(text)));
  return count;
}

EnsembleConfig config_of(const EnsembleCommand& o, bool seeds_given) {
  EnsembleConfig config = o.config;
  if (!o.scene_file.empty()) config.scene = sim::read_scene(o.scene_file);
  if (o.disks) config.scene.disks = *o.disks;
  if (o.mu) config.scene.friction = {*o.mu, *o.mu};
  if (!o.protocol_names.empty()) config.protocols.clear();
  for (const std::string& name : o.protocol_names)
    config.protocols.push_back(sim::protocol_from(name).value());
  for (const std::string& file : o.files) config.files.emplace_back(file);
  // Files alone are an ensemble of their own.
  if (!o.files.empty() && o.protocol_names.empty() && !seeds_given) config.protocols.clear();
  config.molecular_dynamics = options_of(sim::molecular_preset_from(o.preset).value());
  config.solver_states = !o.no_solver_states;
  // Not more than there are.
  const auto most = std::max(config.seeds, static_cast<std::int64_t>(config.files.size()));
  config.uniform_seeds = std::min(count_of("--uniform-seeds", o.uniform_seeds), most);
  config.paper_walk_seeds = std::min(count_of("--paper-walk", o.paper_walk), most);
  config.limit_seeds = std::min(count_of("--limits", o.limits), most);
  return config;
}

struct Range {
  int first = 0;
  int last = 0;
};

/// "3-17", or "5" for one member.
Range range_of(const std::string& text, int members) {
  if (text.empty()) return {0, members - 1};
  Range range;
  std::size_t end = 0;
  try {
    range.first = std::stoi(text, &end);
    range.last = range.first;
    if (end < text.size() && text[end] == '-') {
      const std::string rest = text.substr(end + 1);
      range.last = std::stoi(rest, &end);
      if (end != rest.size()) throw std::invalid_argument(text);
    } else if (end != text.size()) {
      throw std::invalid_argument(text);
    }
  } catch (const std::logic_error&) {
    throw UsageError(fmt::format("--members {}: expected FIRST-LAST or one number, as --dry-run lists them",
                                 excerpt(text)));
  }
  if (range.first < 0 || range.first > range.last || range.last >= members)
    throw UsageError(
        fmt::format("--members {}: the members of this ensemble are 0-{}", excerpt(text), members - 1));
  return range;
}

int list_members(const Plan& plan, const Range& range, const std::filesystem::path& folder,
                 const Context& context) {
  double total = 0;
  int open = 0;
  nlohmann::json json = nlohmann::json::array();
  if (context.prints_report()) say("{:>6}  {:<24} {:>13}\n", "member", "packing", "seconds");
  for (const Member& member : plan.members) {
    if (member.number < range.first || member.number > range.last) continue;
    const bool is_done = member_is_done(member_path(folder, member.name), member);
    total += is_done ? 0 : member.cost;
    open += is_done ? 0 : 1;
    if (context.json) {
      json.push_back({{"member", member.number},
                      {"name", member.name},
                      {"seconds", member.cost},
                      {"hash", member.hash},
                      {"done", is_done}});
    } else if (context.prints_report()) {
      const std::string cost = is_done ? "there already" : fmt::format("{:.1f}", member.cost);
      say("{:>6}  {:<24} {:>13}\n", member.number, member.name, cost);
    }
  }
  if (context.json) {
    std::cout << nlohmann::json{{"members", json}, {"seconds", total}}.dump(2) << '\n';
  } else if (context.prints_report()) {
    say("{} to compute, about {:.0f} s on {}\n", counted(open, "packing"), total / context.thread_count(),
        counted(context.thread_count(), "core"));
  }
  return kDone;
}

void print_molecular_dynamics(const EnsembleConfig& config, const std::string& preset) {
  if (std::none_of(config.protocols.begin(), config.protocols.end(), [](sim::Protocol protocol) {
        return is_simulated_by(protocol, sim::Simulator::kMolecularDynamics);
      }))
    return;
  say("molecular dynamics: preset {}, stiffness {:.10g} mg/r_max, damping {:.10g} mg/r_max sqrt(r_max/g)\n",
      preset, config.molecular_dynamics.k, config.molecular_dynamics.gamma);
}

/// What to expect of each simulation, where one takes long.
void note_time(const EnsembleConfig& config, const Context& context) {
  bool is_told[2] = {false, false};
  for (const sim::Protocol protocol : config.protocols) {
    const auto simulator = starts_from_cd1(protocol) ? sim::Simulator::kContactDynamics
                                                     : properties_of(protocol).simulator.value();
    const std::string notice = sim::time_notice(simulator, config.scene.disks);
    if (notice.empty() || std::exchange(is_told[static_cast<std::size_t>(simulator)], true)) continue;
    context.note("each packing of " + notice);
  }
}

int run(const EnsembleCommand& o, bool seeds_given, const Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  const EnsembleConfig config = config_of(o, seeds_given);
  if (config.sampling.samples > 0) {
    if (const auto defect = config.sampling.defect()) throw InputError(*defect);
  }
  for (const std::string& file : o.files) open_packing(file);
  const Plan plan = make_plan(config);
  const Range range = range_of(o.members, static_cast<int>(plan.members.size()));
  const std::filesystem::path folder = o.folder;
  check_layout(folder);
  try_reading(member_paths({folder}, plan), read_member);
  if (o.dry_run) return list_members(plan, range, folder, context);
  if (!config.protocols.empty())
    require_memory(sim::memory_estimate(config.scene.disks),
                   fmt::format("a simulation of {}", counted(config.scene.disks, "disk")));
  note_time(config, context);
  std::vector<std::filesystem::path> inputs(o.files.begin(), o.files.end());
  inputs.emplace_back(o.scene_file);
  claim_folder(folder, plan, replacement_rule(inputs, o.overwrite, context));
  std::filesystem::create_directories(folder);
  write_plan(folder, plan);

  RunOptions options;
  options.threads = context.thread_count();
  options.first = range.first;
  options.last = range.last;
  options.progress = [show = context.progress()](const Progress& progress) {
    set_remains(fmt::format("done: {}; the same command goes on", progress.details));
    return show(progress);
  };
  options.warn = [&](const std::string& text) { context.warn(text); };
  options.provenance = {context.arguments, context.resolved_config, {{"GLPK", glpk_version()}}, {}};
  const RunSummary summary = compute_members(config, plan, folder, options);
  for (const MemberFailure& failure : summary.failures)
    context.warn(fmt::format("{}: {}", failure.member, failure.reason));

  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const int asked = range.last - range.first + 1;
  if (summary.interrupted) return stopped();
  if (context.prints_report()) print_molecular_dynamics(config, o.preset);
  Outcomes outcomes{.done = summary.done, .skipped = summary.skipped, .failures = summary.failures};
  if (asked < static_cast<int>(plan.members.size())) {
    return report_part(folder, range.first, range.last, outcomes, seconds(), context);
  }
  Collection collection = collect_members(plan, {folder}, context.progress());
  return finish_ensemble(folder, plan, std::move(collection), outcomes, seconds, context);
}

}  // namespace

Command add_ensemble(CLI::App& root) {
  const auto o = std::make_shared<EnsembleCommand>();
  CLI::App* command = root.add_subcommand(
      "ensemble", "Simulate, analyze and sample many packings, and collect the results in one file");
  command
      ->add_option("files", o->files,
                   "Packings that exist already (.h5), to be taken instead of simulated ones")
      ->check(CLI::ExistingFile);
  command
      ->add_option("-o,--out", o->folder,
                   "Folder to write; if it was stopped, the same command goes on where it was")
      ->required();
  CLI::Option* seeds =
      command->add_option("--seeds", o->config.seeds, "Number of seeds; each gives one packing per protocol")
          ->check(positive())
          ->capture_default_str();
  command->add_option("--first-seed", o->config.first_seed, "The first seed; the others follow it")
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--protocols", o->protocol_names,
                   "Protocols, a list of cd1,cd2,md1,md2 (default: all; docs/simulation.md)")
      ->delimiter(',')
      ->check(CLI::IsMember(sim::simulated_names()));
  command->add_option("--scene", o->scene_file, "TOML file of the scene (docs/simulation.md)")
      ->check(CLI::ExistingFile);
  command->add_option("--disks", o->disks, "Number of disks (default: 95, or that of the scene)");
  command->add_option("--mu", o->mu, "Friction coefficient (default: 0.3, or that of the scene)");
  command
      ->add_option(
          "--preset", o->preset,
          "md: stiffness and damping of contacts: 1.2e5, 7.7e4 (paper); 1.2e6, 7.7e4 (paper-overlap); "
          "1.2e6, 558 (stiff)")
      ->check(CLI::IsMember(sim::molecular_preset_names()))
      ->capture_default_str();
  command
      ->add_option("--time-limit", o->config.time_limit,
                   "Largest simulated time of each packing (0: 6 sqrt(Ly/g), as in the paper)")
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--alpha", o->config.contact_dynamics.law.alpha,
                   "cd: fraction of an overlap that is removed per step (0: overlaps stay as they are)")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--start-sweeps", o->config.contact_dynamics.start_sweeps,
                   "cd2: largest number of sweeps of the first step, which starts from no forces")
      ->check(positive())
      ->capture_default_str();
  command
      ->add_option("--samples", o->config.sampling.samples,
                   "Number of solutions of perturb-and-resolve per packing (0: none)")
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--sample-distance", o->config.sampling.distance,
                   "Solve until balanced forces are at most this far away (mg, norm over all contacts)")
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--uniform-seeds", o->uniform_seeds,
                   "Also sample the packings of this many seeds (and files) uniformly; all, or 0 for none")
      ->capture_default_str();
  command
      ->add_option("--paper-walk", o->paper_walk,
                   "Also find dR and dT of the packings of this many seeds (and files) by the walk of the "
                   "paper; all, or 0 for none")
      ->capture_default_str();
  command
      ->add_option("--limits", o->limits,
                   "Also find how far the packings of this many seeds (and files) can be tilted, what their "
                   "highest disk can carry, and with how little friction they stand; all, or 0 for none")
      ->capture_default_str();
  command->add_flag("--no-solver-states", o->no_solver_states,
                    "Leave out dR and dT of the extremal states that the solver happens to find");
  command->add_flag(
      "--smallest-distances", o->config.smallest_distances,
      "Also find dR_min and dT_min: the smallest distance between a state of largest and one of "
      "smallest R (or T), whichever extremal states are taken. It takes longer than the ranges "
      "themselves");
  command->add_option("--members", o->members,
                      "Compute only the packings numbered FIRST-LAST (indet merge joins the parts)");
  add_overwrite_option(*command, o->overwrite);
  command->add_flag("--dry-run", o->dry_run, "Only list the packings, their numbers and estimated times");
  return {command, [o, seeds](const Context& context) { return run(*o, seeds->count() > 0, context); }};
}

}  // namespace indet::app
