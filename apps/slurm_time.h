#pragma once

#include <optional>
#include <string>

namespace indet::app {

/// Slurm's notation of time, in seconds: "90" (minutes), "03:04", "02:03:04", "1-02:03:04"; nothing of
/// "UNLIMITED" and the like.
std::optional<double> seconds_from(const std::string& slurm_time);

/// "1-02:03:00", whole minutes, at least one.
std::string slurm_time(double seconds);

}  // namespace indet::app
