#include "apps/ensemble_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "apps/command.h"
#include "apps/numbers.h"
#include "apps/packing_input.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libsim/molecular_preset.h"
#include "libsim/scene_toml.h"

namespace indet::app {
namespace {

/// "all", or a number.
std::int64_t count_of(const char* option, const std::string& text) {
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (text == "all") return std::numeric_limits<std::int64_t>::max();
  if (error != std::errc() || end != text.data() + text.size() || count < 0)
    throw UsageError(fmt::format("{} {}: expected a number, or all", option, excerpt(text)));
  return count;
}

}  // namespace

EnsembleConfig config_of(const EnsembleArguments& o) {
  const bool seeds_given = o.seeds_option != nullptr && o.seeds_option->count() > 0;
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
  if (config.sampling.samples > 0) {
    if (const auto defect = config.sampling.defect()) throw InputError(*defect);
  }
  for (const std::string& file : o.files) open_packing(file);
  return config;
}

void add_ensemble_options(CLI::App& command, EnsembleArguments& o) {
  command
      .add_option("files", o.files,
                  "Packings that exist already (.h5), to be taken instead of simulated ones")
      ->check(CLI::ExistingFile);
  command
      .add_option("-o,--out", o.folder,
                  "Folder to write; if it was stopped, the same command goes on where it was")
      ->required();
  o.seeds_option =
      command.add_option("--seeds", o.config.seeds, "Number of seeds; each gives one packing per protocol")
          ->check(positive())
          ->capture_default_str();
  command.add_option("--first-seed", o.config.first_seed, "The first seed; the others follow it")
      ->check(not_negative())
      ->capture_default_str();
  command
      .add_option("--protocols", o.protocol_names,
                  "Protocols, a list of cd1,cd2,md1,md2 (default: all; docs/simulation.md)")
      ->delimiter(',')
      ->check(CLI::IsMember(sim::simulated_names()));
  command.add_option("--scene", o.scene_file, "TOML file of the scene (docs/simulation.md)")
      ->check(CLI::ExistingFile);
  command.add_option("--disks", o.disks, "Number of disks (default: 95, or that of the scene)");
  command.add_option("--mu", o.mu, "Friction coefficient (default: 0.3, or that of the scene)");
  command
      .add_option(
          "--preset", o.preset,
          "md: stiffness and damping of contacts: 1.2e5, 7.7e4 (paper); 1.2e6, 7.7e4 (paper-overlap); "
          "1.2e6, 558 (stiff)")
      ->check(CLI::IsMember(sim::molecular_preset_names()))
      ->capture_default_str();
  command
      .add_option("--time-limit", o.config.time_limit,
                  "Largest simulated time of each packing (0: 6 sqrt(Ly/g), as in the paper)")
      ->check(not_negative())
      ->capture_default_str();
  command
      .add_option("--alpha", o.config.contact_dynamics.law.alpha,
                  "cd: fraction of an overlap that is removed per step (0: overlaps stay as they are)")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      .add_option("--start-sweeps", o.config.contact_dynamics.start_sweeps,
                  "cd2: largest number of sweeps of the first step, which starts from no forces")
      ->check(positive())
      ->capture_default_str();
  command
      .add_option("--samples", o.config.sampling.samples,
                  "Number of solutions of perturb-and-resolve per packing (0: none)")
      ->check(not_negative())
      ->capture_default_str();
  command
      .add_option("--sample-distance", o.config.sampling.distance,
                  "Solve until balanced forces are at most this far away (mg, norm over all contacts)")
      ->check(not_negative())
      ->capture_default_str();
  command
      .add_option("--uniform-seeds", o.uniform_seeds,
                  "Also sample the packings of this many seeds (and files) uniformly; all, or 0 for none")
      ->capture_default_str();
  command
      .add_option("--paper-walk", o.paper_walk,
                  "Also find dR and dT of the packings of this many seeds (and files) by the walk of the "
                  "paper; all, or 0 for none")
      ->capture_default_str();
  command
      .add_option("--limits", o.limits,
                  "Also find how far the packings of this many seeds (and files) can be tilted, what their "
                  "highest disk can carry, and with how little friction they stand; all, or 0 for none")
      ->capture_default_str();
  command.add_flag("--no-solver-states", o.no_solver_states,
                   "Leave out dR and dT of the extremal states that the solver happens to find");
  command.add_flag("--smallest-distances", o.config.smallest_distances,
                   "Also find dR_min and dT_min: the smallest distance between a state of largest and one of "
                   "smallest R (or T), whichever extremal states are taken. It takes longer than the ranges "
                   "themselves");
}

}  // namespace indet::app
