#pragma once

#include <CLI/CLI.hpp>

#include "apps/command.h"
#include "apps/simulate_arguments.h"

namespace indet::app {

/// Throws InputError for options of the tilt without --tilt-rate, and for others that a tilt makes no use of.
void refuse_tilt_options_without_effect(const SimulateOptions& o, const CLI::App& command);

/// `indet simulate --tilt-rate`: turns gravity about the packing of --from until disks move (libsim/tilt.h).
int run_tilt(const SimulateOptions& o, const CLI::App& command, const Context& context);

}  // namespace indet::app
