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

std::string describe_expected_dimension(const Packing& packing) {
  const int expected = packing.expected_dimension();
  const int free = packing.floats() ? 2 : 0;
  const int further = 2 * packing.contact_count() - 3 * packing.free_disk_count() + free - expected;
  return fmt::format("2M − 3N{}{} = {}", further > 0 ? fmt::format(" − {}", further) : "",
                     free > 0 ? " + 2" : "", expected);
}

std::string describe_cell(const Cell& cell) {
  std::string text;
  for (const auto& vector : {cell.a, cell.b}) {
    if (vector) text += fmt::format("{}({:.6g}, {:.6g})", text.empty() ? "" : ", ", vector->x(), vector->y());
  }
  return text;
}

std::string describe_stress(const Stress& stress) {
  if (!stress.is_imposed()) return "none";
  std::string text;
  const auto components = stress.components();
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (std::isnan(components[k])) continue;
    text += fmt::format("{}{} = {:.6g}", text.empty() ? "" : ", ", Stress::kNames[k], components[k]);
  }
  return text;
}

nlohmann::json cell_to_json(const Cell& cell) {
  if (!cell.is_periodic()) return {};
  const auto vector = [](const std::optional<Vector2>& v) {
    return v ? nlohmann::json({v->x(), v->y()}) : nlohmann::json();
  };
  return {{"a", vector(cell.a)}, {"b", vector(cell.b)}};
}

nlohmann::json stress_to_json(const Stress& stress) {
  nlohmann::json json = nlohmann::json::object();
  const auto components = stress.components();
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (!std::isnan(components[k])) json[Stress::kNames[k]] = components[k];
  }
  return json;
}

std::string describe_method(const ForceRanges& ranges) {
  switch (ranges.method) {
    case Method::kLp:
      return "linear programs (" + ranges.formulation + ")";
    case Method::kPivotingPaper:
      return fmt::format("{} (neighbour: {}, start: {})", to_string(ranges.method),
                         to_string(ranges.paper_options.neighbour), to_string(ranges.paper_options.start));
    case Method::kBarrier:
      return fmt::format("the barrier method (gap {:g})", ranges.gap);
    case Method::kPivotingTableau:
      break;
  }
  return to_string(ranges.method);
}

}  // namespace indet::app
