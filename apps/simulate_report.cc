#include "apps/simulate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "apps/say.h"
#include "libindet/base/counted.h"

namespace indet::app {

nlohmann::json simulation_to_json(const SimulateOptions& o, const Packing& packing,
                                  const SimulationRecord& record, double seconds) {
  nlohmann::json json = {{"output", o.output},
                         {"protocol", packing.origin.protocol},
                         {"seed", packing.origin.seed},
                         {"disks", packing.disk_count()},
                         {"contacts", packing.contact_count()},
                         {"force_unit", packing.force_unit()},
                         {"seconds", seconds}};
  for (const auto& [name, value] : record.numbers) json[name] = value;
  for (const auto& [name, value] : record.texts) json[name] = value;
  return json;
}

void print_simulation_report(const Packing& packing, const sim::Simulation& result, double seconds) {
  const sim::Polished& polished = result.polished;
  say("{}, seed {}: {}, {}, mean R = {:.4g} mg, mean overlap {:.2e} r_max\n", packing.origin.protocol,
      packing.origin.seed, counted(packing.disk_count(), "disk"), counted(packing.contact_count(), "contact"),
      result.mean_force, result.mean_overlap);
  say("{}\n", result.settled.reason);
  say("polished forces balance to {:.2e} mg, and are {:.2e} mg away from the simulated ones\n",
      polished.residual, polished.distance);
  say("{}\n", counted(polished.sliding, "sliding contact"));
  say("{} in {:.2f} s\n", counted(result.settled.report.steps, "step"), seconds);
}

namespace {

/// The disks that moved, in the order in which they did.
std::vector<int> moved_disks(const sim::Tilt& tilt) {
  std::vector<int> disks;
  for (int i = 0; i < static_cast<int>(tilt.moved_at.size()); ++i) {
    if (!std::isnan(tilt.moved_at[i])) disks.push_back(i);
  }
  std::stable_sort(disks.begin(), disks.end(),
                   [&](int i, int j) { return std::abs(tilt.moved_at[i]) < std::abs(tilt.moved_at[j]); });
  return disks;
}

std::string in_degrees(double angle, const char* format = "{:.2f}°") {
  return fmt::format(fmt::runtime(format), angle * 180 / std::numbers::pi);
}

std::string describe_row(const sim::TiltRow& row, int disks) {
  return fmt::format("at {}: {}, {}, 2M − 3N = {}", in_degrees(row.angle), counted(row.contacts, "contact"),
                     counted(row.sliding, "sliding contact"), 2 * row.contacts - 3 * disks);
}

}  // namespace

nlohmann::json tilt_to_json(const Packing& packing, const sim::Tilt& tilt, const TiltRecord& record) {
  nlohmann::json json;
  for (const auto& [name, value] : record.numbers) json[name] = value;
  for (const auto& [name, value] : record.texts) json[name] = value;
  json["moved_disks"] = nlohmann::json::array();
  for (const int i : moved_disks(tilt))
    json["moved_disks"].push_back({{"id", packing.disks[i].id}, {"angle", tilt.moved_at[i]}});
  for (const sim::TiltRow& row : tilt.rows) {
    json["rows"].push_back({{"angle", row.angle},
                            {"contacts", row.contacts},
                            {"sliding", row.sliding},
                            {"kinetic_energy", row.kinetic_energy},
                            {"displacement", row.displacement}});
  }
  return json;
}

void print_tilt_report(const SimulateOptions& o, const Packing& packing, const sim::Tilt& tilt,
                       double seconds) {
  constexpr std::size_t kShown = 10;
  const int disks = packing.free_disk_count();
  say("{}: {}, gravity turned {} by {:g}° a unit of time ({}), up to {}\n", o.from,
      counted(packing.disk_count(), "disk"), *o.tilt_rate > 0 ? "counter-clockwise" : "clockwise",
      std::abs(*o.tilt_rate), o.protocol_name, in_degrees(tilt.angle()));
  const std::vector<int> moved = moved_disks(tilt);
  if (moved.empty()) say("no disk had moved by {:g} r_max\n", o.tilt_distance);
  for (std::size_t i = 0; i < std::min(moved.size(), kShown); ++i) {
    say("disk {} had moved by {:g} r_max at {}\n", packing.disks[moved[i]].id, o.tilt_distance,
        in_degrees(tilt.moved_at[moved[i]]));
  }
  if (moved.size() > kShown) say("… and {} more\n", moved.size() - kShown);
  say("{}\n", describe_row(tilt.rows.front(), disks));
  const auto at_rest = std::find_if(tilt.rows.begin(), tilt.rows.end(),
                                    [&](const sim::TiltRow& row) { return row.angle == tilt.rest_angle; });
  if (at_rest != tilt.rows.begin() && at_rest != tilt.rows.end()) say("{}\n", describe_row(*at_rest, disks));
  if (at_rest != std::prev(tilt.rows.end())) say("{}\n", describe_row(tilt.rows.back(), disks));
  say("still at rest at {}, if gravity turns no further: {}, forces balance to {:.2e} mg\n",
      in_degrees(tilt.rest_angle), counted(packing.contact_count(), "contact"), tilt.rest.polished.residual);
  say("{} in {:.2f} s\n", counted(tilt.report.steps, "step"), seconds);
}

}  // namespace indet::app
