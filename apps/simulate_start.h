#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/command.h"
#include "apps/simulate_arguments.h"
#include "libsim/simulate.h"

namespace indet::app {

/// The state that the protocol starts from.
struct SimulationStart {
  sim::World world;
  std::optional<Packing> packing = {};  ///< That of --from.
  std::int64_t seed = 0;
  double width = 0;   ///< 0: not known.
  double height = 0;  ///< That the default time limit is reckoned from.
  std::string description;
};

/// Reads the packing of --from, or builds the scene. Throws InputError.
SimulationStart start_of(const SimulateOptions& o, const CLI::App& command, const Context& context);

/// `rigid`: of contact dynamics. Throws InputError for options of the other method.
sim::SimulationOptions simulation_options_of(const SimulateOptions& o, bool rigid, const CLI::App& command);

/// What to expect of a simulation that takes long, before it begins.
void note_time(sim::Simulator simulator, std::int64_t disks, const Context& context);

}  // namespace indet::app
