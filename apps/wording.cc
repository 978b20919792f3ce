#include "apps/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace indet::app {

std::string describe_sliding(std::int64_t sliding, std::int64_t non_transmitting) {
  if (non_transmitting <= 0) return counted(sliding, "sliding contact");
  return fmt::format("{}, and {} without force (which count twice: M_s = {})",
                     counted(sliding - 2 * non_transmitting, "sliding contact"), non_transmitting, sliding);
}

std::string describe_disks(const Packing& packing) {
  const int fixed = packing.fixed_disk_count();
  const std::string all = counted(packing.disk_count(), "disk");
  return fixed == 0 ? all : fmt::format("{} ({} fixed)", all, fixed);
}

std::string describe_wall(const Wall& wall) {
  return wall.name.empty() ? fmt::format("{}", wall.id) : wall.name;
}

const char* reaction_component(Body body, int component) {
  constexpr std::array<const char*, 2> kOfWalls = {"R", "T"};
  constexpr std::array<const char*, 3> kOfDisks = {"x", "y", "torque"};
  const auto k = static_cast<std::size_t>(component);
  return body.is_wall() ? kOfWalls.at(k) : kOfDisks.at(k);
}

std::string describe_levers(const Packing& packing) {
  int given = 0;
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const Contact& contact : packing.contacts) {
    given += std::isnan(contact.lever_a) && std::isnan(contact.lever_b) ? 0 : 1;
    const auto see = [&](double arm) {
      least = std::min(least, arm);
      most = std::max(most, arm);
    };
    see(packing.lever_a(contact) / packing[contact.a].radius);
    if (!contact.b.is_wall()) see(packing.lever_b(contact) / packing[contact.b.disk_id()].radius);
  }
  return fmt::format("of {} of {} given, {:.6g} … {:.6g} of the radius", given,
                     counted(packing.contact_count(), "contact"), least, most);
}

std::string describe_method(const ForceRanges& ranges) {
  switch (ranges.method) {
    case Method::kLp:
      return "linear programs (" + ranges.formulation + ")";
    case Method::kPivotingPaper:
      return fmt::format("{} (neighbour: {}, start: {})", to_string(ranges.method),
                         to_string(ranges.paper_options.neighbour), to_string(ranges.paper_options.start));
    case Method::kPivotingTableau:
      break;
  }
  return to_string(ranges.method);
}

}  // namespace indet::app
