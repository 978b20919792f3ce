#include "apps/bridge/simulation_values.h"

#include <fmt/format.h>

namespace indet {
namespace {

Contact contact_of(const sim::ContactState& state, const sim::World& world) {
  const sim::Levers levers = world.levers_of(state.a, state.b);
  return {.a = DiskId(state.a),
          .b = Body::from_code(state.b),
          .normal = {state.nx, state.ny},
          .gap = state.gap,
          .mu = state.mu,
          .R = state.R,
          .T = state.T,
          .lever_a = levers.a,
          .lever_b = levers.b};
}

const char* name_of(sim::Damping damping) {
  switch (damping) {
    case sim::Damping::kAutomatic:
      return "automatic";
    case sim::Damping::kExplicit:
      return "explicit";
    case sim::Damping::kImplicit:
      return "implicit";
  }
  return "";
}

}  // namespace

SimulationRecord record_of(const sim::Simulation& simulation, const sim::SimulationOptions& options) {
  const sim::Settled& settled = simulation.settled;
  const sim::Polished& polished = simulation.polished;
  SimulationRecord record;
  record.raw_contacts = simulation.raw.contacts;
  record.texts = {{"ending", settled.ending == sim::Ending::kStatic ? "static" : "time limit"},
                  {"reason", settled.reason},
                  {"method", to_string(options.simulator)},
                  {"polish", polished.balanced ? "balanced" : polished.reason}};
  record.numbers = {{"time", settled.time},
                    {"dt", simulation.dt},
                    {"steps", static_cast<double>(settled.report.steps)},
                    {"capped_steps", static_cast<double>(settled.report.capped_steps)},
                    {"sweeps", static_cast<double>(settled.report.sweeps)},
                    {"kinetic_energy", settled.kinetic_energy},
                    {"raw_residual", settled.residual},
                    {"residual", polished.residual},
                    {"cone_violation", polished.cone_violation},
                    {"distance", polished.distance},
                    {"sliding", polished.sliding},
                    {"raw_sliding", simulation.raw_sliding},
                    {"sliding_kept", polished.sliding_kept ? 1 : 0},
                    {"opened", polished.opened},
                    {"implicit_damping", simulation.implicit_damping ? 1 : 0},
                    {"mean_R", simulation.mean_force},
                    {"mean_overlap", simulation.mean_overlap},
                    {"largest_overlap", simulation.largest_overlap}};
  return record;
}

TiltRecord record_of(const sim::Tilt& tilt, const sim::TiltOptions& options, const sim::World& world) {
  const sim::Units units = world.units();
  TiltRecord record;
  record.texts = {{"ending", tilt.moved >= options.most_moved ? "moved" : "angle limit"}};
  record.numbers = {{"rate", options.rate},
                    {"angle_limit", options.angle_limit},
                    {"most_moved", options.most_moved},
                    {"distance", options.distance},
                    {"row_interval", options.row_interval},
                    {"angle", tilt.angle()},
                    {"rest_angle", tilt.rest_angle},
                    {"moved", tilt.moved},
                    {"start_distance", tilt.start_distance},
                    {"steps", static_cast<double>(tilt.report.steps)},
                    {"capped_steps", static_cast<double>(tilt.report.capped_steps)}};
  for (const sim::TiltRow& row : tilt.rows) {
    record.angle.push_back(row.angle);
    record.contacts.push_back(row.contacts);
    record.sliding.push_back(row.sliding);
    record.kinetic_energy.push_back(row.kinetic_energy * units.energy());
    record.displacement.push_back(row.displacement * units.length);
  }
  record.moved_at = tilt.moved_at;
  return record;
}

TrajectoryFrame frame_of(const sim::Frame& frame, const sim::World& world) {
  TrajectoryFrame result;
  result.time = frame.time * world.units().time;
  for (std::size_t i = 0; i < frame.x.size(); ++i) {
    result.positions.emplace_back(frame.x[i], frame.y[i]);
    result.velocities.emplace_back(frame.vx[i], frame.vy[i]);
  }
  result.angles = frame.angle;
  result.angular_velocities = frame.omega;
  for (const sim::ContactState& contact : frame.contacts)
    result.contacts.push_back(contact_of(contact, world));
  return result;
}

StoredCheckpoint stored(const sim::Checkpoint& checkpoint, const std::string& fingerprint,
                        const Trajectory& trajectory) {
  StoredCheckpoint result;
  result.fingerprint = fingerprint;
  result.state = packing_of(checkpoint.world, checkpoint.contacts);
  result.state.origin.protocol = "checkpoint";
  for (const sim::ContactState& contact : checkpoint.contacts) {
    result.spring.push_back(contact.spring);
    result.change.push_back(contact.change);
  }
  result.counters = {{"steps", checkpoint.report.steps},
                     {"capped_steps", checkpoint.report.capped_steps},
                     {"sweeps", checkpoint.report.sweeps},
                     {"contact_updates", checkpoint.report.contact_updates},
                     {"calm_steps", checkpoint.calm_steps}};
  result.trajectory = trajectory;
  return result;
}

sim::Checkpoint loaded(const StoredCheckpoint& checkpoint, const sim::World& start) {
  sim::Checkpoint result;
  result.world = sim::world_of(checkpoint.state, start.friction);
  result.world.levers = start.levers;
  for (std::size_t i = 0; i < checkpoint.state.contacts.size(); ++i) {
    const Contact& contact = checkpoint.state.contacts[i];
    result.contacts.push_back({.a = contact.a.value(),
                               .b = contact.b.code(),
                               .nx = contact.normal.x(),
                               .ny = contact.normal.y(),
                               .gap = contact.gap,
                               .mu = contact.mu,
                               .R = contact.R,
                               .T = contact.T,
                               .change = checkpoint.change[i],
                               .spring = checkpoint.spring[i]});
  }
  const auto counter = [&](const char* name) { return checkpoint.counters.at(name); };
  result.report.steps = counter("steps");
  result.report.capped_steps = counter("capped_steps");
  result.report.sweeps = counter("sweeps");
  result.report.contact_updates = counter("contact_updates");
  result.calm_steps = static_cast<int>(counter("calm_steps"));
  return result;
}

std::string to_toml(const sim::SimulationOptions& options) {
  std::string text = "[simulation]\n";
  const auto line = [&](const char* key, const auto& value) { text += fmt::format("{} = {}\n", key, value); };
  line("method", fmt::format("\"{}\"", to_string(options.simulator)));
  if (options.simulator == sim::Simulator::kContactDynamics) {
    const sim::ContactDynamicsOptions& cd = options.contact_dynamics;
    line("dt", cd.dt);
    line("tolerance", cd.tolerance);
    line("sweeps", cd.max_sweeps);
    line("start_sweeps", cd.start_sweeps);
    line("alpha", cd.law.alpha);
    line("restitution", cd.law.restitution_n);
    line("tangential_restitution", cd.law.restitution_t);
    line("residual", cd.residual);
  } else {
    const sim::MolecularDynamicsOptions& md = options.molecular_dynamics;
    line("stiffness", md.k);
    line("damping", md.gamma);
    line("damping_method", fmt::format("\"{}\"", name_of(md.damping)));
    line("dt", md.dt);
    line("tolerance", md.tolerance);
    line("sweeps", md.max_sweeps);
    line("residual", md.residual);
  }
  line("kinetic_energy", options.kinetic_energy);
  line("calm_steps", options.calm_steps);
  line("time_limit", options.time_limit);
  return text;
}

std::string to_toml(const sim::TiltOptions& options) {
  return fmt::format(
      "[tilt]\nrate = {}\nangle_limit = {}\nmost_moved = {}\ndistance = {}\nrow_interval = {}\n",
      options.rate, options.angle_limit, options.most_moved, options.distance, options.row_interval);
}

}  // namespace indet
