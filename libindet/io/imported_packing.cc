#include "libindet/io/imported_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libindet/base/counted.h"
#include "libindet/base/tolerances.h"

namespace indet {

void warn_of_large_gaps(ImportedPacking& imported) {
  const Packing& packing = imported.packing;
  const double limit = 0.01 * packing.max_radius();
  int count = 0;
  const Contact* worst = nullptr;
  for (const Contact& contact : packing.contacts) {
    if (std::abs(contact.gap) <= limit) continue;
    ++count;
    if (worst == nullptr || std::abs(contact.gap) > std::abs(worst->gap)) worst = &contact;
  }
  if (worst == nullptr) return;
  imported.warnings.push_back(
      fmt::format("{} a gap or overlap above 1 % of the largest radius; the largest, {:.3g}, is between disk "
                  "{} and {} {}",
                  counted(count, "contact has", "contacts have"), worst->gap, packing[worst->a].id,
                  worst->b.is_wall() ? "wall" : "disk",
                  worst->b.is_wall() ? packing[worst->b.wall_id()].id : packing[worst->b.disk_id()].id));
}

void warn_of_idle_friction(ImportedPacking& imported) {
  const Packing& packing = imported.packing;
  struct Group {
    int contacts = 0, with_friction = 0, with_tangential = 0, unknown = 0;
    double mu = 0;
  };
  constexpr int kPairs = -1;
  std::map<int, Group> groups;  // by wall
  int with_tangential = 0;
  for (const Contact& contact : packing.contacts) {
    Group& group = groups[contact.b.is_wall() ? contact.b.wall_id().value() : kPairs];
    ++group.contacts;
    if (contact.mu > 0) ++group.with_friction;
    group.mu = std::max(group.mu, contact.mu);
    if (!std::isfinite(contact.R) || !std::isfinite(contact.T)) {
      ++group.unknown;
    } else if (std::abs(contact.T) > tolerance::kNoTangentialForce * std::abs(contact.R)) {
      ++group.with_tangential;
      ++with_tangential;
    }
  }
  if (with_tangential == 0) return;  // a symmetric packing, or one without friction
  for (const auto& [wall, group] : groups) {
    if (group.with_friction == 0 || group.with_tangential > 0 || group.unknown > 0) continue;
    const std::string where = wall == kPairs
                                  ? "between disks"
                                  : fmt::format("at wall {}", packing[WallId(wall)].name.empty()
                                                                  ? std::to_string(packing[WallId(wall)].id)
                                                                  : packing[WallId(wall)].name);
    imported.warnings.push_back(fmt::format(
        "the tangential forces {} ({}) are all 0, but the friction there is {:g}; if it was 0 in the "
        "simulation, the ranges come out too wide",
        where, counted(group.contacts, "contact"), group.mu));
  }
}

}  // namespace indet
