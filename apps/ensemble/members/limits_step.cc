#include "apps/ensemble/members/limits_step.h"

#include <algorithm>
#include <numbers>
#include <optional>

namespace indet {
namespace {

/// The free disk that lies highest against gravity; the first of several.
std::optional<DiskId> highest_disk(const Packing& packing) {
  std::optional<DiskId> highest;
  for (int i = 0; i < packing.disk_count(); ++i) {
    const auto depth = [&](DiskId disk) { return packing[disk].position.dot(packing.gravity); };
    if (packing[DiskId(i)].fixed) continue;
    if (!highest || depth(DiskId(i)) < depth(*highest)) highest = DiskId(i);
  }
  return highest;
}

/// mg along gravity on one disk.
Loads weight_on(const Packing& packing, DiskId disk) {
  const Vector2 weight = packing.force_unit() * packing.gravity.normalized();
  Loads loads;
  loads.disks.assign(packing.disks.size(), Vector3::Zero());
  loads.disks[static_cast<std::size_t>(disk.value())] << weight, 0;
  return loads;
}

}  // namespace

std::vector<Limit> find_member_limits(const Packing& packing) {
  std::vector<Limit> limits;
  const auto highest = highest_disk(packing);
  if (!packing.gravity.isZero(0) && highest) {
    limits.push_back(find_tilt(packing));
    limits.push_back(find_tilt(packing, std::numbers::pi / 2));
    limits.back().name = limit_name::kTiltOfSeveral;
    limits.push_back(find_load(packing, limit_name::kLoadOnTop, weight_on(packing, *highest)));
  }
  const auto has_friction = [](const Contact& contact) { return contact.mu > 0; };
  if (std::any_of(packing.contacts.begin(), packing.contacts.end(), has_friction))
    limits.push_back(
        find_friction(packing, limit_name::kFriction, std::vector<bool>(packing.contacts.size(), true)));
  return limits;
}

}  // namespace indet
