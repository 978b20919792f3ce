#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
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
#include "apps/ensemble_arguments.h"
#include "apps/ensemble_output.h"
#include "apps/interruption.h"
#include "apps/memory_limit.h"
#include "apps/output_files.h"
#include "apps/say.h"
#include "apps/scheduler.h"
#include "apps/shared_run.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/base/stopwatch.h"
#include "libindet/io/destination.h"
#include "libindet/lp/glpk_problem.h"
#include "libsim/memory_estimate.h"
#include "libsim/time_estimate.h"

namespace indet::app {
namespace {

struct EnsembleCommand {
  EnsembleArguments arguments;
  ShareArguments share;
  std::string members;
  bool dry_run = false;
  bool overwrite = false;
};

/// The members that are asked for: "3-17", or "5" for one; else those of a shard; else all.
struct Selection {
  std::vector<Member> members;
  std::string name;  ///< "members 3-17", "shard 3/8"; empty: all.
  std::string next;  ///< What to do once they and all others are done.
};

std::vector<Member> numbered(const std::string& text, const Plan& plan) {
  int first = 0, last = 0;
  std::size_t end = 0;
  try {
    first = last = std::stoi(text, &end);
    if (end < text.size() && text[end] == '-') {
      const std::string rest = text.substr(end + 1);
      last = std::stoi(rest, &end);
      if (end != rest.size()) throw std::invalid_argument(text);
    } else if (end != text.size()) {
      throw std::invalid_argument(text);
    }
  } catch (const std::logic_error&) {
    throw UsageError(fmt::format("--members {}: expected FIRST-LAST or one number, as --dry-run lists them",
                                 excerpt(text)));
  }
  if (first < 0 || first > last || last >= std::ssize(plan.members)) {
    throw UsageError(fmt::format("--members {}: the members of this ensemble are 0-{}", excerpt(text),
                                 plan.members.size() - 1));
  }
  return {plan.members.begin() + first, plan.members.begin() + last + 1};
}

Selection selection_of(const EnsembleCommand& o, const Plan& plan, const Context& context) {
  if (!o.members.empty()) {
    if (!o.share.shard.empty()) throw UsageError("--members and --shard do not go together");
    return {numbered(o.members, plan), "members " + o.members, "join the parts with indet merge"};
  }
  const std::optional<Shard> shard = share_of(o.share, context);
  if (!shard || shard->count == 1) return {plan.members, "", ""};
  return {members_of(plan, *shard), "shard " + shard->name(),
          "once all shards are done, the same command without --shard collects the results"};
}

int list_members(const Selection& selection, const std::filesystem::path& folder, const Context& context) {
  double total = 0;
  int open = 0;
  nlohmann::json json = nlohmann::json::array();
  if (context.prints_report()) say("{:>6}  {:<24} {:>13}\n", "member", "packing", "seconds");
  for (const Member& member : selection.members) {
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

RunOptions run_options(const EnsembleCommand& o, TaskLog& log, const Context& context) {
  RunOptions options;
  options.threads = context.thread_count();
  options.progress = shared_progress(context);
  options.warn = [&context](const std::string& text) { context.warn(text); };
  options.time_budget = time_budget_of(o.share);
  options.log = &log;
  options.checkpoints.hold_on = [] { return std::make_shared<CheckpointTime>(); };
  options.checkpoints.on_written = [&log] { log.note_checkpoint(); };
  options.provenance = {context.arguments, context.resolved_config, {{"GLPK", glpk_version()}}, {}};
  return options;
}

BatchSummary compute(const EnsembleCommand& o, const EnsembleConfig& config, const Plan& plan,
                     const Selection& selection, const Context& context) {
  const std::filesystem::path folder = o.arguments.folder;
  return run_with_log(folder, {.work = plan.hash(), .shard = selection.name}, context, [&](TaskLog& log) {
    return compute_members(config, plan, selection.members, folder, run_options(o, log, context));
  });
}

int run(const EnsembleCommand& o, const Context& context) {
  const Stopwatch watch;
  const EnsembleConfig config = config_of(o.arguments);
  const Plan plan = make_plan(config);
  const Selection selection = selection_of(o, plan, context);
  const std::filesystem::path folder = o.arguments.folder;
  check_layout(folder);
  try_reading(member_paths({folder}, selection.members), read_member);
  if (o.dry_run) return list_members(selection, folder, context);
  if (!config.protocols.empty())
    require_memory(sim::memory_estimate(config.scene.disks),
                   fmt::format("a simulation of {}", counted(config.scene.disks, "disk")));
  note_time(config, context);
  std::vector<std::filesystem::path> inputs(o.arguments.files.begin(), o.arguments.files.end());
  inputs.emplace_back(o.arguments.scene_file);
  claim_folder(folder, selection.members, replacement_rule(inputs, o.overwrite, context));
  make_folder(folder);
  write_plan(folder, plan);

  const BatchSummary summary = compute(o, config, plan, selection, context);
  for (const ItemFailure& failure : summary.failures)
    context.warn(fmt::format("{}: {}", failure.item, failure.reason));
  if (summary.is_interrupted) return stopped();

  const auto seconds = [&] { return watch.seconds(); };
  if (context.prints_report()) print_molecular_dynamics(config, o.arguments.preset);
  if (!selection.name.empty() || summary.out_of_time > 0)
    return report_share({folder, "member", selection.name, selection.next}, summary, seconds(), context);
  Collection collection = collect_members(plan, {folder}, context.progress());
  return finish_ensemble(folder, plan, std::move(collection), summary, seconds, context);
}

}  // namespace

Command add_ensemble(CLI::App& root) {
  const auto o = std::make_shared<EnsembleCommand>();
  CLI::App* command = root.add_subcommand(
      "ensemble", "Simulate, analyze and sample many packings, and collect the results in one file");
  add_ensemble_options(*command, o->arguments);
  add_share_options(*command, "seeds", o->share);
  command->add_option("--members", o->members,
                      "Compute only the packings numbered FIRST-LAST (indet merge joins the parts)");
  add_overwrite_option(*command, o->overwrite);
  command->add_flag("--dry-run", o->dry_run, "Only list the packings, their numbers and estimated times");
  return {command, [o](const Context& context) { return run(*o, context); }};
}

}  // namespace indet::app
