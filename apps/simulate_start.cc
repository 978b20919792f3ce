#include "apps/simulate_start.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "apps/memory_limit.h"
#include "apps/packing_input.h"
#include "libindet/base/error.h"
#include "libindet/base/toml_text.h"
#include "libindet/io/packing_file.h"
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

void require_memory_for(std::int64_t disks) {
  require_memory(sim::memory_estimate(disks), fmt::format("a simulation of {}", counted(disks, "disk")));
}

}  // namespace

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

void note_time(sim::Simulator simulator, std::int64_t disks, const Context& context) {
  const std::string notice = sim::time_notice(simulator, disks);
  if (!notice.empty()) context.note(notice);
}

SimulationStart start_of(const SimulateOptions& o, const CLI::App& command, const Context& context) {
  const bool second = starts_from_cd1(o.protocol());
  if (!o.from.empty()) {
    refuse_scene_options(command);
    Packing packing = read_packing(open_packing(o.from));
    require_memory_for(packing.disk_count());
    const sim::Friction friction = sim::friction_of(packing, {o.mu, o.wall_mu ? o.wall_mu : o.mu});
    SimulationStart start{
        .world = sim::world_of(packing, friction), .seed = packing.origin.seed, .description = ""};
    if (o.seed) start.seed = static_cast<std::int64_t>(*o.seed);
    start.description = "from = " + toml_text(o.from) + "\n" + packing.origin.config;
    const Scene usual{.disks = packing.disk_count(), .radius_max = packing.max_radius()};
    start.width = packing.origin.width;
    start.height =
        o.height.value_or(packing.origin.height > 0 ? packing.origin.height : usual.resolved().height);
    if (second) start.world.bring_to_rest();
    start.packing = std::move(packing);
    return start;
  }
  const Scene scene = scene_of(o);
  if (const auto reason = scene.defect()) throw InputError(*reason);
  require_memory_for(scene.disks);
  const Scene resolved = scene.resolved();
  SimulationStart start{.world = sim::build(scene),
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

}  // namespace indet::app
