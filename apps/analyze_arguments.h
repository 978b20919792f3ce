#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/analysis_arguments.h"
#include "apps/command.h"
#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/analyze_options.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// The options of indet analyze that say what its results are.
struct AnalyzeArguments {
  std::string packing;
  std::string method = "auto";
  std::optional<double> gap;
  std::vector<std::string> conditions;
  AnalysisArguments analysis;
};

/// `arguments` must outlive the command.
void add_analyze_options(CLI::App& command, AnalyzeArguments& arguments);

/// The packing of a file, with the conditions. Throws like apply_conditions.
Packing packing_of(const Hdf5File& file, const AnalyzeArguments& arguments);

/// Throws UsageError where options contradict each other or have no effect, InputError where memory would not
/// do.
AnalyzeOptions resolve(const AnalyzeArguments& arguments, const Packing& packing, const Context& context);

/// Tells of ranges that were written to a file; returns the exit status.
int report_ranges(const Packing& packing, const ForceRanges& ranges, const std::string& output,
                  const Context& context);

}  // namespace indet::app
