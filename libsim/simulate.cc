#include "libsim/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet::sim {
namespace {

/// Explicit dynamics looks at the static criterion every so many steps.
constexpr int kExplicitStride = 50;
/// Steps that a collision of two undamped disks is resolved with, at least.
constexpr double kStepsPerCollision = 40;
/// Default step of the implicit law: 1/640 of the time γ/k in which overdamped contacts relax, for `paper`.
constexpr double kImplicitStep = 1e-3;

SpringLaw law_of(const MolecularDynamicsOptions& options, const Units& units) {
  return {.k = options.k * units.stiffness(), .gamma = options.gamma * units.damping()};
}

bool is_implicit(const MolecularDynamicsOptions& options) {
  if (options.damping != Damping::kAutomatic) return options.damping == Damping::kImplicit;
  // Two disks of mean mass: reduced mass 1/2, critical damping 2 √(k/2).
  return options.gamma > std::sqrt(2 * options.k);
}

double explicit_step(const World& world, const MolecularDynamicsOptions& options, const Units& units) {
  const double stable = largest_explicit_step(world, law_of(options, units)) / units.time;
  double lightest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < world.size(); ++i) {
    if (!world.fixed[i]) lightest = std::min(lightest, world.mass[i] / units.mass);
  }
  const double collision = std::numbers::pi * std::sqrt(lightest / (2 * options.k));
  return std::min(stable / 2, collision / kStepsPerCollision);
}

double step_of(const World& world, const SimulationOptions& options, const Units& units) {
  if (options.simulator == Simulator::kContactDynamics) return options.contact_dynamics.dt;
  const MolecularDynamicsOptions& md = options.molecular_dynamics;
  if (md.dt > 0) return md.dt;
  return is_implicit(md) ? kImplicitStep : explicit_step(world, md, units);
}

/// Contacts that transmit force and are at their Coulomb limit, by the paper's ε.
int sliding_contacts(const Packing& packing) {
  const double epsilon = tolerance::kSliding * packing.internal_force_unit();
  return static_cast<int>(
      std::count_if(packing.contacts.begin(), packing.contacts.end(), [&](const Contact& contact) {
        return contact.mu > 0 && contact.R >= epsilon &&
               contact.mu * contact.R - std::abs(contact.T) < epsilon;
      }));
}

using Reason = std::optional<std::string>;

Reason rigid_defect(const ContactDynamicsOptions& cd) {
  if (!(cd.dt > 0) || !std::isfinite(cd.dt)) return fmt::format("dt must be positive, but is {}", cd.dt);
  if (!(cd.residual > 0)) return fmt::format("residual must be positive, but is {}", cd.residual);
  if (!(cd.tolerance >= 0)) return fmt::format("tolerance must not be negative, but is {}", cd.tolerance);
  if (cd.max_sweeps < 1) return fmt::format("sweeps must be at least 1, but is {}", cd.max_sweeps);
  if (cd.start_sweeps < 1) return fmt::format("start sweeps must be at least 1, but is {}", cd.start_sweeps);
  if (!(cd.law.alpha >= 0 && cd.law.alpha <= 1))
    return fmt::format("alpha must be in [0, 1], but is {}", cd.law.alpha);
  for (const double e : {cd.law.restitution_n, cd.law.restitution_t}) {
    if (!(e >= 0 && e <= 1)) return fmt::format("restitution must be in [0, 1], but is {}", e);
  }
  return {};
}

Reason spring_defect(const World& world, const MolecularDynamicsOptions& md) {
  if (!(md.k > 0) || !std::isfinite(md.k)) return fmt::format("stiffness must be positive, but is {}", md.k);
  if (!(md.gamma >= 0) || !std::isfinite(md.gamma))
    return fmt::format("damping must not be negative, but is {}", md.gamma);
  if (!(md.residual > 0)) return fmt::format("residual must be positive, but is {}", md.residual);
  if (!(md.tolerance >= 0)) return fmt::format("tolerance must not be negative, but is {}", md.tolerance);
  if (!(md.dt >= 0)) return fmt::format("dt must be positive, but is {}", md.dt);
  if (md.max_sweeps < 1) return fmt::format("sweeps must be at least 1, but is {}", md.max_sweeps);
  if (is_implicit(md)) {
    if (!(md.gamma > 0)) return "implicit damping needs a damping constant above 0";
    return {};
  }
  const Units units = world.units();
  const double stable = largest_explicit_step(world, law_of(md, units)) / units.time;
  if (!(md.dt <= stable)) {
    return fmt::format(
        "dt = {:.3g} is not stable for stiffness {:.4g} and damping {:.4g}: explicit damping needs dt ≤ "
        "{:.3g} "
        "(2 dt κγ + dt² κk < 4 with κ = {:.3g}); take a smaller dt, or implicit damping",
        md.dt, md.k, md.gamma, stable, stiffness_factor(world) * units.mass);
  }
  return {};
}

}  // namespace

std::optional<std::string> SimulationOptions::defect(const World& world) const {
  if (world.free_size() == 0) return "there are no disks that can move";
  if (!(time_limit > 0)) return fmt::format("the time limit must be positive, but is {}", time_limit);
  if (!(kinetic_energy >= 0) || calm_steps < 0) return "the static criterion must not be negative";
  return simulator == Simulator::kContactDynamics ? rigid_defect(contact_dynamics)
                                                  : spring_defect(world, molecular_dynamics);
}

std::unique_ptr<Stepper> make_stepper(const World& world, const std::vector<ContactState>& contacts,
                                      const SimulationOptions& options) {
  const Units units = world.units();
  const double dt = step_of(world, options, units) * units.time;
  if (options.simulator == Simulator::kContactDynamics) {
    const ContactDynamicsOptions& cd = options.contact_dynamics;
    return std::make_unique<ImplicitStepper>(world, contacts,
                                             ImplicitOptions{.dt = dt,
                                                             .springs = {},
                                                             .rigid = cd.law,
                                                             .max_sweeps = cd.max_sweeps,
                                                             .start_sweeps = cd.start_sweeps,
                                                             .tolerance = cd.tolerance});
  }
  const MolecularDynamicsOptions& md = options.molecular_dynamics;
  const SpringLaw law = law_of(md, units);
  if (!is_implicit(md)) return std::make_unique<ExplicitStepper>(world, contacts, law, dt);
  return std::make_unique<ImplicitStepper>(world, contacts,
                                           ImplicitOptions{.dt = dt,
                                                           .springs = law,
                                                           .rigid = {},
                                                           .max_sweeps = md.max_sweeps,
                                                           .start_sweeps = md.max_sweeps,
                                                           .tolerance = md.tolerance,
                                                           .loosening = tolerance::kSweepLoosening});
}

Simulation simulate(const World& start, const std::vector<ContactState>& contacts,
                    const SimulationOptions& options, const Listener& listener, const Checkpoint* resume) {
  const World& world = resume ? resume->world : start;
  if (const auto reason = options.defect(world)) throw InputError(*reason);
  const auto stepper = make_stepper(world, resume ? resume->contacts : contacts, options);
  const Settled settled = settle(*stepper, stop_criteria(options), stride_of(options), listener, resume);
  return conclude(*stepper, settled, options);
}

int stride_of(const SimulationOptions& options) {
  const bool rigid = options.simulator == Simulator::kContactDynamics;
  return rigid || is_implicit(options.molecular_dynamics) ? 1 : kExplicitStride;
}

StopCriteria stop_criteria(const SimulationOptions& options) {
  const bool rigid = options.simulator == Simulator::kContactDynamics;
  return {.kinetic_energy = options.kinetic_energy,
          .calm_steps = options.calm_steps,
          .residual = rigid ? options.contact_dynamics.residual : options.molecular_dynamics.residual,
          .time_limit = options.time_limit};
}

Simulation conclude(const Stepper& stepper, const Settled& settled, const SimulationOptions& options) {
  const bool rigid = options.simulator == Simulator::kContactDynamics;
  Simulation result;
  result.settled = settled;
  result.implicit_damping = !rigid && is_implicit(options.molecular_dynamics);
  result.dt = stepper.dt() / stepper.world().units().time;
  result.raw = packing_of(stepper.world(), stepper.forces());
  PolishOptions polish_options = options.polish;
  // Elastic forces of a sliding contact are off the limit by what damping still contributes.
  if (!rigid)
    polish_options.sliding = std::max(polish_options.sliding, 10 * options.molecular_dynamics.residual);
  result.polished = polish(result.raw, result.raw.simulated_forces().value(), polish_options);
  if (!result.polished.balanced && result.settled.ending == Ending::kTimeLimit)
    result.polished.reason += " (the time limit came before the disks were at rest; a larger one may help)";
  result.packing = result.raw;
  const ForceUnits force_units = result.raw.force_units();
  if (result.polished.balanced) {
    result.packing.contacts.clear();
    for (int i = 0; i < result.raw.contact_count(); ++i) {
      Contact contact = result.raw[ContactId(i)];
      contact.R = result.polished.forces[2 * i];
      contact.T = result.polished.forces[2 * i + 1];
      if (contact.R > options.polish.transmitting * force_units.internal_in_scene())
        result.packing.contacts.push_back(contact);
    }
  }
  for (const Contact& contact : result.packing.contacts) {
    const double overlap = std::max(0.0, -contact.gap) / result.packing.max_radius();
    result.mean_overlap += overlap / result.packing.contact_count();
    result.largest_overlap = std::max(result.largest_overlap, overlap);
    result.mean_force += contact.R / force_units.weight_in_scene() / result.packing.contact_count();
  }
  result.raw_sliding = sliding_contacts(result.raw);
  return result;
}

double default_time_limit(const World& world, double height) {
  const Units units = world.units();
  return 6 * std::sqrt(height / units.length);
}

}  // namespace indet::sim
