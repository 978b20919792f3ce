#include "apps/ensemble/members/member.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/bridge/perturb_record.h"
#include "apps/bridge/simulation_values.h"
#include "libindet/base/error.h"
#include "libindet/base/stopwatch.h"
#include "libindet/range/analyze.h"

namespace indet {
namespace {

/// A listener that stops where `progress` says so, and keeps what is worth it.
sim::Listener listener_for(const MemberCheckpoint& checkpoint, const ProgressCallback& progress) {
  const CheckpointRules& rules = checkpoint.rules();
  const Stopwatch watch;
  const auto is_worth_keeping = [watch, &rules] { return watch.seconds() >= rules.worth_keeping; };
  sim::Listener listener;
  listener.progress = [=, &rules, time = std::shared_ptr<void>()](const Progress& report) mutable {
    if (!time && rules.hold_on && is_worth_keeping()) time = rules.hold_on();
    return !progress || progress(report);
  };
  listener.checkpoint_seconds = rules.interval;
  listener.on_checkpoint = [=, &checkpoint](const sim::Checkpoint& state) {
    if (is_worth_keeping()) checkpoint.save(state);
  };
  return listener;
}

sim::Simulation run_protocol(const EnsembleConfig& config, const sim::Scene& scene, const sim::World& world,
                             sim::Protocol protocol, const sim::Listener& listener,
                             const std::optional<sim::Checkpoint>& resume) {
  sim::SimulationOptions options = simulation_options_of(config, protocol);
  if (options.time_limit == 0) options.time_limit = sim::default_time_limit(world, scene.height);
  if (const auto reason = options.defect(world)) throw InputError(*reason);
  sim::Simulation result = sim::simulate(world, {}, options, listener, resume ? &*resume : nullptr);
  if (!result.polished.balanced)
    throw LibraryError(
        fmt::format("{}: the forces do not balance: {}", to_string(protocol), result.polished.reason));
  return result;
}

void simulate_member(const EnsembleConfig& config, const Member& member, const std::optional<Packing>& first,
                     const MemberCheckpoint& checkpoint, const ProgressCallback& progress,
                     MemberResult& result) {
  Stopwatch watch;
  const sim::Scene scene = scene_of(config, member);
  sim::World world = sim::build(scene);
  if (starts_from_cd1(member.protocol)) {
    const Packing start =
        first ? *first
              : run_protocol(config, scene, world, sim::Protocol::kCd1, {.progress = progress}, {}).packing;
    if (!first) result.seconds["simulate_start"] = watch.seconds();
    watch = {};
    world = sim::world_of(start, scene.friction);
    world.bring_to_rest();
  }
  const sim::Simulation simulation = run_protocol(config, scene, world, member.protocol,
                                                  listener_for(checkpoint, progress), checkpoint.load(world));
  result.packing = simulation.packing;
  result.packing.origin = {
      .protocol = to_string(member.protocol), .seed = member.seed, .config = member.config};
  result.simulation = record_of(simulation, simulation_options_of(config, member.protocol));
  result.seconds["simulate"] = watch.seconds();
}

void analyze_member(const EnsembleConfig& config, const ProgressCallback& progress, MemberResult& result) {
  AnalyzeOptions options;
  options.progress = progress;
  options.solver_states = config.solver_states;
  options.smallest_distances = config.smallest_distances;
  const Stopwatch watch;
  result.ranges = analyze(result.packing, options);
  result.seconds["analyze"] = watch.seconds();
  const double unit = result.ranges.force_unit;
  result.extremal = count_extremal_forces(result.ranges.states, result.ranges.vertex, unit);
  if (!result.ranges.solver_states) return;
  const SolverStates& landed = *result.ranges.solver_states;
  StateDistances distances = state_distances(landed.states, landed.vertex, unit);
  result.solver_d_R = std::move(distances.d_R);
  result.solver_d_T = std::move(distances.d_T);
  result.solver_extremal = count_extremal_forces(landed.states, landed.vertex, unit);
}

/// The accepted solutions in the order in which they were found: 2M × S.
WeightStates chain_of(const sim::PerturbEnsemble& ensemble, const Packing& packing) {
  Eigen::MatrixXd chain(2 * packing.contact_count(), ensemble.accepted);
  Eigen::Index column = 0;
  for (const sim::PerturbSample& sample : ensemble.samples) {
    if (sample.accepted) chain.col(column++) = sample.forces;
  }
  return packing.force_units().weights(SceneStates(std::move(chain)));
}

/// Perturb-and-resolve; returns its states.
WeightStates sample_member(const EnsembleConfig& config, const Member& member,
                           const ProgressCallback& progress, MemberResult& result) {
  if (config.sampling.samples <= 0 || !result.packing.has_simulated_forces()) return {};
  if (result.packing.contacts.empty()) return {};
  const Stopwatch watch;
  sim::PerturbOptions options = config.sampling;
  options.seed = static_cast<std::uint64_t>(std::max<std::int64_t>(member.seed, 0));
  const sim::PerturbEnsemble ensemble = sim::perturb_and_resolve(result.packing, options, progress);
  result.sampling = record_of(ensemble, options);
  result.seconds["sample"] = watch.seconds();
  return chain_of(ensemble, result.packing);
}

void sample_member_uniformly(const EnsembleConfig& config, const Member& member, const WeightStates& chain,
                             const ProgressCallback& progress, MemberResult& result) {
  const Stopwatch watch;
  UniformOptions options = config.uniform;
  options.seed = static_cast<std::uint64_t>(std::max<std::int64_t>(member.seed, 0));
  options.progress = progress;
  result.uniform = sample_uniformly(result.packing, result.ranges, chain, options);
  result.seconds["sample_uniform"] = watch.seconds();
}

void walk_member(const ProgressCallback& progress, MemberResult& result) {
  const Stopwatch watch;
  result.paper_walk = walk_as_the_paper(result.packing, progress);
  result.seconds["paper_walk"] = watch.seconds();
}

void find_limits(const ProgressCallback& progress, MemberResult& result) {
  if (progress && !progress({"limits", 0, 1, ""})) throw Interrupted();
  const Stopwatch watch;
  result.limits = find_member_limits(result.packing);
  result.seconds["limits"] = watch.seconds();
}

}  // namespace

ExtremalForces count_extremal_forces(const Rows<double>& states, const Table4<std::int32_t>& vertex,
                                     double force_unit) {
  ExtremalForces result;
  const Eigen::Index contacts = vertex.rows();
  for (std::size_t column = 0; column < 4; ++column) {
    std::vector<std::int32_t>& counts = result.counts[column];
    for (Eigen::Index i = 0; i < contacts; ++i) {
      const int row = vertex(i, static_cast<Eigen::Index>(column));
      if (row < 0) continue;
      for (Eigen::Index c = 0; c < contacts; ++c) {
        const double force = std::max(0.0, states(row, 2 * c) / force_unit);
        const auto bin = static_cast<std::size_t>(force);
        if (bin >= counts.size()) counts.resize(bin + 1, 0);
        ++counts[bin];
      }
    }
  }
  return result;
}

MemberResult compute_member(const EnsembleConfig& config, const Member& member,
                            const std::optional<Packing>& given, const std::optional<Packing>& first,
                            const MemberCheckpoint& checkpoint, const ProgressCallback& progress) {
  MemberResult result;
  if (given) {
    result.packing = *given;
  } else {
    simulate_member(config, member, first, checkpoint, progress, result);
  }
  analyze_member(config, progress, result);
  const WeightStates chain = sample_member(config, member, progress, result);
  if (member.paper_walk) walk_member(progress, result);
  if (member.uniform) sample_member_uniformly(config, member, chain, progress, result);
  if (member.limits) find_limits(progress, result);
  return result;
}

}  // namespace indet
