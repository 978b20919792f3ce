#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "libindet/range/analyze.h"

namespace indet::app {

/// The options that say how ranges are found, of the subcommands that find them.
struct AnalysisArguments {
  std::string accuracy = "standard";
  std::string contacts = "all";
  std::uint64_t seed = 1;
  std::optional<double> exact_budget;
  std::optional<int> calibrate;     ///< of --accuracy estimate
  std::string reactions = "auto";   ///< of analyze
  std::string duals = "none";       ///< of analyze
  bool smallest_distances = false;  ///< of analyze
  std::string formulation = "auto";
  std::string states = "auto";
  std::string states_of = "all";
  std::optional<std::string> neighbour, start;  ///< of the walks of pivoting-paper
};

/// Which levels of --accuracy a subcommand offers.
enum class Levels : std::uint8_t { kFloatingPoint, kAll };

/// `arguments` must outlive the command.
void add_analysis_options(CLI::App& command, AnalysisArguments& arguments, Levels levels);

/// True if every result is to be proven in rational arithmetic after the analysis.
bool is_exact(const AnalysisArguments& arguments);

/// True if ranges are to be estimated instead of found.
bool is_estimate(const AnalysisArguments& arguments);

/// Throws UsageError if options say how to walk, where nothing does: the method is not pivoting-paper.
void require_no_walk(const AnalysisArguments& arguments);

/// The names of the values of an enumeration that has to_string.
template <class Enum, std::size_t n>
std::vector<std::string> names_of(const std::array<Enum, n>& values) {
  std::vector<std::string> names;
  for (const Enum value : values) names.emplace_back(to_string(value));
  return names;
}

/// The value of that name, of which CLI11 has checked that it is one.
template <class Enum, std::size_t n>
Enum value_of(const std::string& name, const std::array<Enum, n>& values) {
  return *std::find_if(values.begin(), values.end(), [&](Enum value) { return name == to_string(value); });
}

/// "3,7,12-20" as numbers, of which a range has each. Throws UsageError, which shows `whole`, the value of
/// `option`, if `text` is no such list or names a contact that there is not.
std::vector<int> parse_contact_list(const std::string& option, const std::string& whole,
                                    const std::string& text, int contacts);

/// For a packing with this number of contacts. Throws UsageError where options contradict each other or name
/// a contact that there is not.
AnalyzeOptions resolve(const AnalysisArguments& arguments, int contacts, const Context& context);

}  // namespace indet::app
