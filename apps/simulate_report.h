#pragma once

#include <nlohmann/json.hpp>

#include "apps/simulate_arguments.h"
#include "libindet/io/simulation_file.h"
#include "libsim/simulate.h"
#include "libsim/tilt.h"

namespace indet::app {

/// What `simulate` says about the packing that it made.
nlohmann::json simulation_to_json(const SimulateOptions& o, const Packing& packing,
                                  const SimulationRecord& record, double seconds);
void print_simulation_report(const Packing& packing, const sim::Simulation& result, double seconds);

/// What it says about a tilt. `packing`: the one that is written.
nlohmann::json tilt_to_json(const Packing& packing, const sim::Tilt& tilt, const TiltRecord& record);
void print_tilt_report(const SimulateOptions& o, const Packing& packing, const sim::Tilt& tilt,
                       double seconds);

}  // namespace indet::app
