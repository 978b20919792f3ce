#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libsim/protocol.h"

namespace indet::app {

/// Options as given; what is empty keeps the default of the simulator or of the scene file.
struct SimulateOptions {
  std::string protocol_name;
  std::string scene_file, from, output;
  std::optional<std::uint64_t> seed;
  // Scene.
  std::optional<int> disks, columns;
  std::vector<double> radius, gravity;
  std::optional<double> density, mu, wall_mu, force_unit, width, height, funnel_angle, jitter;
  std::string container;
  // Simulator.
  std::string preset = "paper", damping_method = "automatic";
  std::optional<double> stiffness, damping, dt, tolerance, alpha, restitution, tangential_restitution;
  std::optional<int> sweeps, start_sweeps;
  std::optional<double> residual, kinetic_energy, time_limit;
  // Tilt, in degrees.
  std::optional<double> tilt_rate;
  double tilt_limit = 90, tilt_every = 0.05, tilt_distance = 1e-3;
  int tilt_moved = 1;
  // Run.
  double every = 0;
  double checkpoint = 600;
  bool resume = false;
  bool overwrite = false;

  bool tilts() const { return tilt_rate.has_value(); }
  sim::Protocol protocol() const { return sim::protocol_from(protocol_name).value(); }
};

/// `o` must outlive the command.
void add_scene_options(CLI::App& command, SimulateOptions& o);
void add_method_options(CLI::App& command, SimulateOptions& o);
void add_tilt_options(CLI::App& command, SimulateOptions& o);

}  // namespace indet::app
