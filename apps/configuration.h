#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace indet::app {

/// Lets every option of a command be set by an environment variable: INDET_FORMULATION for --formulation.
void name_environment_variables(CLI::App& command);

/// Parses the command line, which sets `file` if it has --config; then takes from that TOML file whatever
/// neither the command line nor the environment sets, and parses again. Throws CLI::ParseError; InputError
/// for a bad file (unknown keys included).
void parse_with_configuration(CLI::App& root, const std::vector<std::string>& arguments,
                              const std::string& file);

/// Every option of this run as TOML that --config reads: the global ones, then a table for the subcommand.
std::string resolved_configuration(const CLI::App& root, const CLI::App& command);
/// The table of the subcommand alone: what the result may depend on.
std::string resolved_configuration(const CLI::App& command);

}  // namespace indet::app
