#include "libindet/limit/limit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/limit/friction_limit.h"
#include "libindet/limit/mechanism.h"
#include "libindet/limit/tilt.h"

namespace indet {

namespace {

bool touches(const Contact& contact, DiskId disk) {
  return contact.a == disk || (!contact.b.is_wall() && contact.b.disk_id() == disk);
}

/// The disk that moves alone at an angle below `least`.
std::optional<DiskId> loose_disk(const TiltLimits& limits, double least) {
  for (const LimitEnd* end : {&limits.smallest, &limits.largest}) {
    if (end->outcome != LimitOutcome::kReached || std::abs(end->value) >= least) continue;
    const std::vector<DiskId> moving = moving_disks(end->motion);
    if (moving.size() == 1) return moving.front();
  }
  return {};
}

/// With forces of 0 at contacts of disks that were left out.
LimitEnd on_all_contacts(const Packing& packing, const std::vector<DiskId>& left_out, LimitEnd end) {
  if (left_out.empty() || end.forces.value().size() == 0) return end;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(2 * packing.contact_count());
  Eigen::Index next = 0;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    if (std::any_of(left_out.begin(), left_out.end(), [&](DiskId disk) { return touches(contact, disk); }))
      continue;
    forces.segment<2>(2 * i) = end.forces.value().segment<2>(next);
    next += 2;
  }
  end.forces = SceneForces(std::move(forces));
  return end;
}

}  // namespace

const char* to_string(LimitKind kind) {
  switch (kind) {
    case LimitKind::kTilt:
      return "tilt";
    case LimitKind::kLoad:
      return "load";
    case LimitKind::kFriction:
      return "friction";
  }
  return "?";
}

Packing without(Packing packing, const std::vector<DiskId>& disks) {
  if (disks.empty()) return packing;
  packing.named_force_unit = packing.force_unit();
  for (const DiskId disk : disks) {
    packing.disks[static_cast<std::size_t>(disk.value())].fixed = true;
    std::erase_if(packing.contacts, [&](const Contact& contact) { return touches(contact, disk); });
  }
  return packing;
}

Limit find_tilt(const Packing& packing, double ignore_below, const LimitOptions& options) {
  Limit limit;
  TiltLimits found = find_tilt_limits(packing, options);
  while (const std::optional<DiskId> loose = loose_disk(found, ignore_below)) {
    std::vector<DiskId> left_out = limit.left_out;
    left_out.push_back(*loose);
    TiltLimits next = find_tilt_limits(without(packing, left_out), options);
    if (!next.stands()) break;
    found = std::move(next);
    limit.left_out = std::move(left_out);
  }
  limit.kind = LimitKind::kTilt;
  limit.load = "tilt";
  limit.smallest = on_all_contacts(packing, limit.left_out, std::move(found.smallest));
  limit.largest = on_all_contacts(packing, limit.left_out, std::move(found.largest));
  limit.is_first_of_several = found.is_first_of_several;
  return limit;
}

Limit find_load(const Packing& packing, std::string name, Loads change, const LimitOptions& options) {
  LoadLimits found = find_load_limits(packing, change, options);
  Limit limit;
  limit.kind = LimitKind::kLoad;
  limit.load = std::move(name);
  limit.change = std::move(change);
  limit.smallest = std::move(found.smallest);
  limit.largest = std::move(found.largest);
  return limit;
}

Limit find_friction(const Packing& packing, std::string name, std::vector<bool> scaled,
                    const LimitOptions& options) {
  FrictionLimit found = find_friction_limit(packing, scaled, options);
  Limit limit;
  limit.kind = LimitKind::kFriction;
  limit.load = std::move(name);
  limit.scaled = std::move(scaled);
  limit.smallest = std::move(found.infimum);
  limit.is_attained = found.is_attained;
  limit.largest.outcome =
      limit.smallest.outcome == LimitOutcome::kReached ? LimitOutcome::kNever : limit.smallest.outcome;
  if (limit.largest.outcome == LimitOutcome::kNever)
    limit.largest.value = limit.largest.lower = limit.largest.upper = kInfinity;
  return limit;
}

Packing at_end(const Packing& packing, const Limit& limit, const LimitEnd& end) {
  if (limit.kind == LimitKind::kFriction) return with_friction(packing, limit.scaled, end.value);
  Packing tilted = without(packing, limit.left_out);
  if (limit.kind == LimitKind::kLoad) return under(limit.change, end.value, std::move(tilted));
  tilted.gravity = turned_gravity(packing, end.value);
  return tilted;
}

}  // namespace indet
