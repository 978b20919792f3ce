#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "libindet/io/import_format.h"
#include "libindet/io/stress_rule.h"

namespace indet::app {

/// Options of `indet import`, as they are given.
struct ImportArguments {
  std::string format, input, output;
  DumpFiles dumps;
  std::vector<std::string> friction, lever, fixed, stress, columns, walls, density;
  std::vector<double> gravity = {0, -1};
  double force_unit = 0;
  std::string plane = "xy";
  std::optional<double> time;
  std::optional<double> balance_tolerance;
  bool overwrite = false;
};

/// What they come to.
struct ImportOrder {
  const ImportFormat* format = nullptr;
  ImportRequest request;
  LeverRule levers;
  StressRule stress;
};

void add_import_options(CLI::App& command, ImportArguments& arguments);

/// Throws UsageError where options are missing or do not fit together. (Not the parser's work: they may come
/// from --config, after the first pass over the command line.)
ImportOrder import_order(const ImportArguments& arguments, const CLI::App& command);

}  // namespace indet::app
