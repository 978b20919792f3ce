#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "apps/command.h"
#include "libindet/range/analyze.h"

namespace indet::app {

/// The options that say how ranges are found, of the subcommands that find them.
struct AnalysisArguments {
  std::string accuracy = "standard";
  std::string contacts = "all";
  std::uint64_t seed = 1;
  std::string formulation = "auto";
  std::string states = "auto";
};

/// Which levels of --accuracy a subcommand offers.
enum class Levels : std::uint8_t { kFloatingPoint, kWithExact };

/// `arguments` must outlive the command.
void add_analysis_options(CLI::App& command, AnalysisArguments& arguments, Levels levels);

/// True if every result is to be proven in rational arithmetic after the analysis.
bool is_exact(const AnalysisArguments& arguments);

/// "lp", "pivoting-paper" or "pivoting-tableau", as CLI11 has checked.
Method parse_method(const std::string& name);

/// For a packing with this number of contacts. Throws UsageError where options contradict each other or name
/// a contact that there is not.
AnalyzeOptions resolve(const AnalysisArguments& arguments, int contacts, const Context& context);

}  // namespace indet::app
