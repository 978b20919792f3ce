#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/ensemble/members/plan.h"

namespace indet::app {

/// The options that say what an ensemble is, and where.
struct EnsembleArguments {
  std::string folder, scene_file, preset = "paper", uniform_seeds = "20", paper_walk = "60", limits = "60";
  std::optional<int> disks;
  std::optional<double> mu;
  EnsembleConfig config;
  std::vector<std::string> protocol_names, files;
  bool no_solver_states = false;
  const CLI::Option* seeds_option = nullptr;
};

/// `arguments` must outlive the command.
void add_ensemble_options(CLI::App& command, EnsembleArguments& arguments);

/// Throws UsageError; InputError for a scene or sampling that cannot be, or a file that is no packing.
EnsembleConfig config_of(const EnsembleArguments& arguments);

}  // namespace indet::app
