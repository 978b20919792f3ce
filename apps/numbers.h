#pragma once

#include <CLI/CLI.hpp>

namespace indet::app {

/// Checks of one option: a finite number ≥ 0, or > 0.
CLI::Validator not_negative();
CLI::Validator positive();

/// Whether an option takes numbers, whole or not.
bool takes_numbers(const CLI::Option& option);

/// Every option of a command that takes reals takes finite ones alone, and one that takes whole numbers takes
/// those of 64 bits in decimal notation (CLI11 would take 010 for eight), of which numbers without a sign are
/// at most 2⁶³ − 1, as files hold them. Call it when all options were added.
void require_numbers(CLI::App& command);

/// Parses, and says of whole numbers that are too large for their option what they do not fit into.
void parse_numbers(CLI::App& root, std::vector<std::string> arguments);

}  // namespace indet::app
