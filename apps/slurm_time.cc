#include "apps/slurm_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace indet::app {

std::optional<double> seconds_from(const std::string& text) {
  int days = 0, hours = 0, minutes = 0, seconds = 0;
  char rest = 0;
  const char* const all = text.c_str();
  if (std::sscanf(all, "%d-%d:%d:%d%c", &days, &hours, &minutes, &seconds, &rest) == 4 ||
      (days = 0, std::sscanf(all, "%d:%d:%d%c", &hours, &minutes, &seconds, &rest) == 3) ||
      (hours = 0, std::sscanf(all, "%d:%d%c", &minutes, &seconds, &rest) == 2) ||
      (seconds = 0, std::sscanf(all, "%d%c", &minutes, &rest) == 1))
    return ((days * 24.0 + hours) * 60 + minutes) * 60 + seconds;
  return std::nullopt;
}

std::string slurm_time(double seconds) {
  const auto minutes = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(seconds / 60)));
  const std::string clock = fmt::format("{:02}:{:02}:00", minutes / 60 % 24, minutes % 60);
  return minutes < 24 * 60 ? clock : fmt::format("{}-{}", minutes / (24 * 60), clock);
}

}  // namespace indet::app
