#include "libsim/time_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace indet::sim {
namespace {

/// Below this much time nothing needs to be said.
constexpr double kNoticed = 60;
/// Of the time of contact dynamics: what molecular dynamics has to take less than to be worth a change.
constexpr double kClearlyFaster = 0.75;

struct Law {
  double seconds;  ///< with 1600 disks
  double power;
  std::int64_t most_measured;
};

constexpr Law law_of(Simulator simulator) {
  return simulator == Simulator::kContactDynamics ? Law{63, 1.7, 3200} : Law{115, 1.2, 10000};
}

std::string rounded(double seconds) {
  if (seconds < 90) return "a minute";
  if (seconds < 5400) return fmt::format("{:.0f} minutes", seconds / 60);
  return fmt::format("{:.0f} hours", std::max(2.0, seconds / 3600));
}

}  // namespace

double seconds_estimate(Simulator simulator, std::int64_t disks) {
  const Law law = law_of(simulator);
  return law.seconds * std::pow(static_cast<double>(disks) / 1600, law.power);
}

std::int64_t most_measured(Simulator simulator) { return law_of(simulator).most_measured; }

std::string time_notice(Simulator simulator, std::int64_t disks) {
  const double seconds = seconds_estimate(simulator, disks);
  if (seconds < kNoticed) return "";
  const Law law = law_of(simulator);
  const bool is_measured = disks <= law.most_measured;
  std::string text = fmt::format(
      "{} disks by {} take about {} of processor time to come to rest, within a factor of two; it grows as "
      "N^{:.1f}{}",
      disks, to_string(simulator), rounded(seconds), law.power,
      is_measured ? "" : fmt::format(" (measured with up to {} disks)", law.most_measured));
  const double other = seconds_estimate(Simulator::kMolecularDynamics, disks);
  if (simulator == Simulator::kContactDynamics && other < kClearlyFaster * seconds)
    text += fmt::format("; --protocol md1 takes about {}", rounded(other));
  return text;
}

}  // namespace indet::sim
