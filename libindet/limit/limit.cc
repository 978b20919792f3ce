#include "libindet/limit/limit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/limit/friction_limit.h"
#include "libindet/limit/mechanism.h"
#include "libindet/limit/tilt.h"
#include "libindet/packing/force_bounds.h"

namespace indet {

namespace {

bool touches(const Contact& contact, DiskId disk) {
  return contact.a == disk || (!contact.b.is_wall() && contact.b.disk_id() == disk);
}

bool is_left_out(const Contact& contact, const std::vector<DiskId>& disks) {
  return std::any_of(disks.begin(), disks.end(), [&](DiskId disk) { return touches(contact, disk); });
}

/// Disks that move alone at an angle below `least`.
std::vector<DiskId> loose_disks(const TiltLimits& limits, double least) {
  std::vector<DiskId> loose;
  for (const LimitEnd* end : {&limits.smallest, &limits.largest}) {
    if (end->outcome != LimitOutcome::kReached || std::abs(end->value) >= least) continue;
    const std::vector<DiskId> moving = moving_disks(end->motion);
    if (moving.size() == 1) loose.push_back(moving.front());
  }
  return loose;
}

/// With forces of 0 at contacts of disks that were left out.
LimitEnd on_all_contacts(const Packing& packing, const std::vector<DiskId>& left_out, LimitEnd end) {
  if (left_out.empty() || end.forces.value().size() == 0) return end;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(2 * packing.contact_count());
  Eigen::Index next = 0;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    if (is_left_out(contact, left_out)) continue;
    forces.segment<2>(2 * i) = end.forces.value().segment<2>(next);
    next += 2;
  }
  end.forces = SceneForces(std::move(forces));
  // Multipliers of bounds of what was left out are 0.
  const std::vector<ForceBound> bounds = force_bounds(packing);
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(bounds.size()));
  next = 0;
  for (std::size_t k = 0; end.motion.bounds.size() > 0 && k < bounds.size(); ++k) {
    if (!is_left_out(packing[bounds[k].contact], left_out))
      multipliers[static_cast<Eigen::Index>(k)] = end.motion.bounds[next++];
  }
  if (end.motion.disks.rows() > 0) end.motion.bounds = std::move(multipliers);
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
  for (bool is_done = false; !is_done;) {
    is_done = true;
    for (const DiskId loose : loose_disks(found, ignore_below)) {
      std::vector<DiskId> left_out = limit.left_out;
      left_out.push_back(loose);
      TiltLimits next = find_tilt_limits(without(packing, left_out), options);
      if (!next.stands()) continue;
      found = std::move(next);
      limit.left_out = std::move(left_out);
      is_done = false;
      break;
    }
  }
  limit.kind = LimitKind::kTilt;
  limit.name = "tilt";
  limit.smallest = on_all_contacts(packing, limit.left_out, std::move(found.smallest));
  limit.largest = on_all_contacts(packing, limit.left_out, std::move(found.largest));
  limit.is_first_of_several = found.is_first_of_several;
  return limit;
}

Limit find_load(const Packing& packing, std::string name, Loads change, const LimitOptions& options) {
  LoadLimits found = find_load_limits(packing, change, options);
  Limit limit;
  limit.kind = LimitKind::kLoad;
  limit.name = std::move(name);
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
  limit.name = std::move(name);
  limit.scaled = std::move(scaled);
  limit.smallest = std::move(found.infimum);
  limit.is_attained = found.is_attained;
  limit.largest.outcome =
      limit.smallest.outcome == LimitOutcome::kReached ? LimitOutcome::kNever : limit.smallest.outcome;
  if (limit.largest.outcome == LimitOutcome::kNever)
    limit.largest.value = limit.largest.lower = limit.largest.upper = kInfinity;
  return limit;
}

Packing under_mechanism(const Packing& packing, const Limit& limit, const LimitEnd& end) {
  if (limit.kind != LimitKind::kFriction) return without(packing, limit.left_out);
  const bool is_known = std::isfinite(end.lower) && end.lower >= 0;
  return is_known ? with_friction(packing, limit.scaled, end.lower) : packing;
}

Packing packing_at(const Packing& packing, const Limit& limit, double value) {
  if (limit.kind == LimitKind::kFriction) return with_friction(packing, limit.scaled, value);
  Packing tilted = without(packing, limit.left_out);
  if (limit.kind == LimitKind::kLoad) return under(limit.change, value, std::move(tilted));
  tilted.gravity = turned(packing.gravity, value);
  return tilted;
}

}  // namespace indet
