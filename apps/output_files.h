#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "apps/command.h"
#include "libindet/io/replacement.h"

namespace indet::app {

/// Adds --overwrite to a subcommand that writes files.
void add_overwrite_option(CLI::App& command, bool& overwrite);

/// What a run that reads `inputs` (and the file of --config) may replace. Files that are there are looked at
/// in a process of its own, as in try_reading().
Replacement replacement_rule(std::vector<std::filesystem::path> inputs, bool overwrite,
                             const Context& context);

/// Throws InputError unless the run may write a file of this kind to `output`. If that is where standard
/// output goes, the texts of the run go to standard error from now on, so that they do not mix with the file.
void claim_output(const std::filesystem::path& output, FileKind kind, const Replacement& rule);

}  // namespace indet::app
