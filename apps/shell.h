#pragma once

#include <optional>
#include <string>

namespace indet::app {

/// The first line that a command of the shell prints; empty where it prints none, or cannot be run.
std::string first_line_of(const std::string& command);

/// Slurm's notation of time, in seconds: "90" (minutes), "03:04", "02:03:04", "1-02:03:04"; nothing of
/// "UNLIMITED" and the like.
std::optional<double> seconds_from(const std::string& text);

}  // namespace indet::app
