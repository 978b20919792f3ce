#include "apps/ensemble/members/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "apps/bridge/simulation_values.h"
#include "apps/ensemble/members/limits_step.h"
#include "libindet/base/error.h"
#include "libindet/base/version.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/sha256.h"
#include "libindet/io/utf8.h"
#include "libindet/range/paper_options.h"
#include "libsim/scene_toml.h"

namespace indet {
namespace {

using sim::Protocol;

std::string digest(const std::string& text) {
  Sha256 sha;
  sha.update(text.data(), text.size());
  return sha.hex();
}

/// What is done with every packing.
std::string analysis_toml(const EnsembleConfig& config, std::int64_t seed) {
  std::string text =
      fmt::format("[analysis]\nstates = \"canonical\"\nsolver_states = {}\n", config.solver_states);
  // Only where they are asked for: the hashes of other ensembles do not know of it.
  if (config.smallest_distances) text += "smallest_distances = true\n";
  const sim::PerturbOptions& s = config.sampling;
  text += fmt::format("[sampling]\nsamples = {}\n", s.samples);
  if (s.samples > 0) {
    text += fmt::format("width = {}\nchains = {}\ndistance = {}\ntolerance = {}\nsweeps = {}\n", s.width,
                        s.chains, s.distance, s.solver.tolerance, s.solver.max_sweeps);
    if (seed >= 0) text += fmt::format("seed = {}\n", seed);
  }
  return text;
}

/// Added for the packings that are sampled uniformly: the hashes of the others do not know of it.
std::string uniform_toml(const UniformOptions& u, std::int64_t seed) {
  std::string text = fmt::format("[uniform]\neffective = {}\nlargest_rhat = {}\nchains = {}\nlimit = {}\n",
                                 u.effective, u.largest_rhat, u.chains, u.limit);
  if (seed >= 0) text += fmt::format("seed = {}\n", seed);
  return text;
}

void add_uniform_sampling(const EnsembleConfig& config, double disks, Member& member) {
  member.uniform = true;
  member.config += uniform_toml(config.uniform, std::max<std::int64_t>(member.seed, 0));
  member.cost += 0.6 * std::pow(disks / 95, 3);
}

/// The same for those that the paper's walk analyses.
std::string paper_walk_toml() {
  const PaperOptions options;
  return fmt::format("[paper_walk]\nneighbour = \"{}\"\nstart = \"{}\"\n", to_string(options.neighbour),
                     to_string(options.start));
}

/// The same for those whose limits are found.
std::string limits_toml() {
  return fmt::format("[limits]\nnames = [\"{}\", \"{}\", \"{}\", \"{}\"]\n", limit_name::kTilt,
                     limit_name::kTiltOfSeveral, limit_name::kLoadOnTop, limit_name::kFriction);
}

void add_paper_walk(double disks, Member& member) {
  member.paper_walk = true;
  member.config += paper_walk_toml();
  member.cost += 0.4 * std::pow(disks / 95, 4);
}

void add_limits(double disks, Member& member) {
  member.limits = true;
  member.config += limits_toml();
  member.cost += 0.4 * std::pow(disks / 95, 3);
}

/// Seconds on one core, measured with 95 disks (docs/simulation.md, docs/ensemble.md); the exponents fit runs
/// with 95 to 400. It orders the members and feeds the estimate of the remaining time.
double cost_of(const EnsembleConfig& config, Protocol protocol, double disks) {
  const double size = disks / 95;
  const double analysis = 0.21;
  const double distances = config.smallest_distances ? 0.42 : 0;
  const bool implicit = config.molecular_dynamics.gamma > 1e4;
  double rest = 0.0034 * config.sampling.samples;
  if (protocol == Protocol::kCd1) rest += 0.5;
  if (protocol == Protocol::kCd2) rest += 0.25;
  if (protocol == Protocol::kMd1) rest += implicit ? 1.2 : 0.7;
  if (protocol == Protocol::kMd2) rest += 0.13;
  return (analysis + distances) * std::pow(size, 3) + rest * std::pow(size, 1.5);
}

/// `number` of its protocol, from 0.
Member simulated_member(const EnsembleConfig& config, Protocol protocol, std::int64_t number) {
  const std::int64_t seed = config.first_seed + number;
  Member member;
  member.name = simulated_name(protocol, seed);
  member.protocol = protocol;
  member.seed = seed;
  member.cost = cost_of(config, protocol, config.scene.disks);
  const sim::Scene scene = scene_of(config, member);
  member.config = fmt::format("version = \"{}\"\nprotocol = \"{}\"\n", version(), to_string(protocol));
  member.config += sim::to_toml(scene) + to_toml(simulation_options_of(config, protocol));
  if (starts_from_cd1(protocol))
    member.config += "# start\n" + to_toml(simulation_options_of(config, Protocol::kCd1));
  member.config += analysis_toml(config, seed);
  if (number < config.uniform_seeds) add_uniform_sampling(config, config.scene.disks, member);
  if (number < config.paper_walk_seeds) add_paper_walk(config.scene.disks, member);
  if (number < config.limit_seeds) add_limits(config.scene.disks, member);
  return member;
}

Member member_of_file(const EnsembleConfig& config, const std::filesystem::path& path, std::int64_t number) {
  Member member;
  member.name = path.stem().string();
  member.source = path;
  const Hdf5File file = open_indet_file(path);
  member.seed = file.integer_attribute("/parameters", "seed");
  const auto disks = static_cast<double>(file.shape("/particles/disks/id", 1)[0]);
  member.cost = cost_of(config, Protocol::kFile, disks);
  member.config = fmt::format("version = \"{}\"\nfile = \"{}\"\n", version(), packing_digest(file));
  member.config += analysis_toml(config, std::max<std::int64_t>(member.seed, 0));
  if (number < config.uniform_seeds) add_uniform_sampling(config, disks, member);
  if (number < config.paper_walk_seeds) add_paper_walk(disks, member);
  if (number < config.limit_seeds) add_limits(disks, member);
  return member;
}

std::string config_of(const EnsembleConfig& config) {
  std::string text = fmt::format("version = \"{}\"\nfirst_seed = {}\nseeds = {}\nprotocols = [", version(),
                                 config.first_seed, config.protocols.empty() ? 0 : config.seeds);
  for (const Protocol protocol : config.protocols) text += fmt::format("\"{}\", ", to_string(protocol));
  text += "]\n";
  if (!config.protocols.empty()) text += sim::to_toml(config.scene.resolved());
  for (const Protocol protocol : config.protocols)
    text += fmt::format("# {}\n{}", to_string(protocol), to_toml(simulation_options_of(config, protocol)));
  text += analysis_toml(config, -1);
  if (config.uniform_seeds > 0)
    text += uniform_toml(config.uniform, -1) + fmt::format("packings = {}\n", config.uniform_seeds);
  if (config.paper_walk_seeds > 0)
    text += paper_walk_toml() + fmt::format("packings = {}\n", config.paper_walk_seeds);
  if (config.limit_seeds > 0) text += limits_toml() + fmt::format("packings = {}\n", config.limit_seeds);
  return text;
}

/// What stays together when members are dealt.
struct Groups {
  std::vector<double> costs;
  std::vector<std::size_t> of_member;
};

Groups groups_of(const Plan& plan) {
  Groups groups;
  std::map<std::int64_t, std::size_t> group_of_seed;
  for (const Member& member : plan.members) {
    std::size_t group = groups.costs.size();
    if (member.protocol != Protocol::kFile) group = group_of_seed.emplace(member.seed, group).first->second;
    if (group == groups.costs.size()) groups.costs.push_back(0);
    groups.costs[group] += member.cost;
    groups.of_member.push_back(group);
  }
  return groups;
}

}  // namespace

std::string simulated_name(Protocol protocol, std::int64_t seed) {
  return fmt::format("{}-{:04}", to_string(protocol), seed);
}

std::string Plan::hash() const {
  std::string text;
  for (const Member& member : members) text += member.name + " " + member.hash + "\n";
  return digest(text);
}

std::vector<Member> members_of(const Plan& plan, const Shard& shard) {
  const Groups groups = groups_of(plan);
  const std::vector<int> share_of = deal(groups.costs, shard.count);
  std::vector<Member> members;
  for (std::size_t i = 0; i < plan.members.size(); ++i) {
    if (share_of[groups.of_member[i]] == shard.number) members.push_back(plan.members[i]);
  }
  return members;
}

std::vector<double> dealt_costs(const Plan& plan) { return groups_of(plan).costs; }

sim::Scene scene_of(const EnsembleConfig& config, const Member& member) {
  sim::Scene scene = config.scene;
  scene.seed = static_cast<std::uint64_t>(member.seed);
  return scene.resolved();
}

sim::SimulationOptions simulation_options_of(const EnsembleConfig& config, Protocol protocol) {
  sim::SimulationOptions options;
  options.time_limit = config.time_limit;
  options.contact_dynamics = config.contact_dynamics;
  if (is_simulated_by(protocol, sim::Simulator::kMolecularDynamics)) {
    options.simulator = sim::Simulator::kMolecularDynamics;
    options.molecular_dynamics = config.molecular_dynamics;
  }
  return options;
}

Plan make_plan(const EnsembleConfig& config) {
  Plan plan;
  if (!config.protocols.empty()) {
    if (const auto defect = config.scene.defect()) throw InputError(*defect);
    for (const Protocol protocol : config.protocols) {
      for (std::int64_t i = 0; i < config.seeds; ++i)
        plan.members.push_back(simulated_member(config, protocol, i));
    }
  }
  for (const std::filesystem::path& path : config.files)
    plan.members.push_back(member_of_file(config, path, &path - config.files.data()));
  if (plan.members.empty()) throw InputError("there is nothing to do: no seed and no file");
  std::set<std::string> names;
  for (Member& member : plan.members) {
    member.number = static_cast<int>(&member - plan.members.data());
    member.hash = digest(member.config);
    if (valid_utf8_length(member.name) < member.name.size())
      throw InputError(
          fmt::format("the name of the file {} is not UTF-8; rename it", member.source.string()));
    if (!names.insert(member.name).second)
      throw InputError(fmt::format("two packings have the name {}", member.name));
  }
  plan.config = config_of(config);
  return plan;
}

}  // namespace indet
