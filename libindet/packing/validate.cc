#include "libindet/packing/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

using Reason = std::optional<std::string>;

Reason not_finite(const char* name, double value) {
  if (std::isfinite(value)) return {};
  return fmt::format("{} must be a finite number, but is {}", name, value);
}

Reason not_positive(const char* name, double value) {
  if (auto reason = not_finite(name, value)) return reason;
  if (value > 0) return {};
  return fmt::format("{} must be positive, but is {}", name, value);
}

Reason negative(const char* name, double value) {
  if (auto reason = not_finite(name, value)) return reason;
  if (value >= 0) return {};
  return fmt::format("{} must not be negative, but is {}", name, value);
}

/// The first of several checks that fails.
template <class... Checks>
Reason first_of(Checks&&... checks) {
  Reason reason;
  static_cast<void>(((reason = checks(), reason.has_value()) || ...));
  return reason;
}

Reason not_unit(const Vector2& normal) {
  const double length = normal.norm();
  if (std::abs(length - 1) <= tolerance::kNormalLength) return {};
  return fmt::format("the normal ({}, {}) must have length 1, but has length {}", normal.x(), normal.y(),
                     length);
}

Reason disk_defect(const Disk& disk) {
  const auto inertial = disk.fixed ? negative : not_positive;
  return first_of(
      [&] { return not_finite("x", disk.position.x()); }, [&] { return not_finite("y", disk.position.y()); },
      [&] { return not_positive("radius", disk.radius); }, [&] { return inertial("mass", disk.mass); },
      [&] { return inertial("inertia", disk.inertia); }, [&] { return not_finite("angle", disk.angle); },
      [&] { return not_finite("velocity", disk.velocity.sum()); },
      [&] { return not_finite("angular velocity", disk.angular_velocity); },
      [&] { return not_finite("load", disk.load.sum()); });
}

Reason infinite(const char* name, double value) {
  if (!std::isinf(value)) return {};
  return fmt::format("{} must be a finite number or empty, but is {}", name, value);
}

Reason wall_defect(const Wall& wall) {
  return first_of(
      [&] { return not_finite("px", wall.point.x()); }, [&] { return not_finite("py", wall.point.y()); },
      [&] { return not_finite("nx", wall.normal.x()); }, [&] { return not_finite("ny", wall.normal.y()); },
      [&] { return not_unit(wall.normal); }, [&] { return infinite("load_n", wall.load_n); },
      [&] { return infinite("load_t", wall.load_t); });
}

Reason index_defect(const Packing& packing, const Contact& contact) {
  if (contact.a.value() < 0 || contact.a.value() >= packing.disk_count()) {
    return fmt::format("body a is disk {}, but the disks are 0 … {}", contact.a.value(),
                       packing.disk_count() - 1);
  }
  if (contact.b.is_wall() && contact.b.wall_id().value() >= packing.wall_count()) {
    return fmt::format("body b is wall {}, but the scene has {}", contact.b.wall_id().value(),
                       counted(packing.wall_count(), "wall"));
  }
  if (!contact.b.is_wall() && contact.b.disk_id().value() >= packing.disk_count()) {
    return fmt::format("body b is disk {}, but the disks are 0 … {}", contact.b.code(),
                       packing.disk_count() - 1);
  }
  if (!contact.b.is_wall() && contact.b.disk_id() == contact.a) {
    return fmt::format("disk {} cannot touch itself", contact.a.value());
  }
  if (!packing.has_equations(contact.a) && !packing.has_equations(contact.b)) {
    return fmt::format("disk {} is fixed, and so is body b: nothing has to balance their forces",
                       packing[contact.a].id);
  }
  return {};
}

/// `lever` is NaN (the radius), or in (0, 2r]: a longer one does not belong to this disk.
Reason lever_defect(const char* name, double lever, double radius) {
  if (std::isnan(lever)) return {};
  if (auto reason = not_positive(name, lever)) return reason;
  if (lever <= 2 * radius) return {};
  return fmt::format("{} is {}, more than the diameter {} of the disk", name, lever, 2 * radius);
}

Reason levers_defect(const Packing& packing, const Contact& contact) {
  if (auto reason = lever_defect("lever_a", contact.lever_a, packing[contact.a].radius)) return reason;
  if (!contact.b.is_wall()) {
    return lever_defect("lever_b", contact.lever_b, packing[contact.b.disk_id()].radius);
  }
  if (std::isnan(contact.lever_b)) return {};
  return "body b is a wall, which has no lever, so lever_b must be empty";
}

Reason normal_defect(const Packing& packing, const Contact& contact) {
  if (auto reason = not_unit(contact.normal)) return reason;
  Vector2 expected;
  try {
    expected = geometric_normal(packing, contact.a, contact.b);
  } catch (const InputError& error) {
    return error.what();
  }
  if ((contact.normal - expected).norm() <= tolerance::kNormalDirection) return {};
  return fmt::format(
      "the normal ({}, {}) disagrees with the positions, which give ({}, {}); it must point from b to a",
      contact.normal.x(), contact.normal.y(), expected.x(), expected.y());
}

/// Bodies that touch are nearer than the radius of the smaller one. Its centre is not behind a wall, and it
/// is not wholly inside of a disk.
Reason gap_defect(const Packing& packing, const Contact& contact) {
  const Disk& a = packing[contact.a];
  const double gap = geometric_gap(packing, contact.a, contact.b);
  const double radius =
      contact.b.is_wall() ? a.radius : std::min(a.radius, packing[contact.b.disk_id()].radius);
  const std::string other = contact.b.is_wall() ? fmt::format("wall {}", packing[contact.b.wall_id()].id)
                                                : fmt::format("disk {}", packing[contact.b.disk_id()].id);
  if (gap > radius) {
    return fmt::format("disk {} and {} are {:.6g} apart, more than the radius {:.6g}: they do not touch",
                       a.id, other, gap, radius);
  }
  if (gap > (contact.b.is_wall() ? -radius : -2 * radius)) return {};
  if (contact.b.is_wall()) {
    return fmt::format("the centre of disk {} is behind {}: does the normal ({}, {}) point into the domain?",
                       a.id, other, contact.normal.x(), contact.normal.y());
  }
  return fmt::format("disk {} and {} overlap by {:.6g}, more than the diameter {:.6g} of the smaller one",
                     a.id, other, -gap, 2 * radius);
}

/// An interval of a force that holds no number, or does not read as one.
Reason bounds_defect(const char* force, double lo, double hi, double least) {
  if (std::isnan(lo) || std::isnan(hi)) return fmt::format("{}_lo and {}_hi must be numbers", force, force);
  if (lo > hi) return fmt::format("{}_lo is {}, more than {}_hi, which is {}", force, lo, force, hi);
  if (hi < least) return fmt::format("{}_hi is {}, but contacts only push: {} ≥ 0", force, hi, force);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (lo == kNone || hi == -kNone) return fmt::format("{}_lo and {}_hi leave no finite force", force, force);
  return {};
}

Reason contact_defect(const Packing& packing, const Contact& contact) {
  return first_of(
      [&] { return index_defect(packing, contact); }, [&] { return negative("mu", contact.mu); },
      [&] { return not_finite("nx", contact.normal.x()); },
      [&] { return not_finite("ny", contact.normal.y()); }, [&] { return not_finite("gap", contact.gap); },
      [&] { return normal_defect(packing, contact); }, [&] { return gap_defect(packing, contact); },
      [&] { return levers_defect(packing, contact); },
      [&]() -> Reason {  // NaN means "unknown"
        if (!std::isinf(contact.R) && !std::isinf(contact.T)) return {};
        return "R and T must be finite or unknown";
      },
      [&] { return bounds_defect("R", contact.R_lo, contact.R_hi, 0); },
      [&] {
        return bounds_defect("T", contact.T_lo, contact.T_hi, -std::numeric_limits<double>::infinity());
      });
}

/// A pair of bodies as one key, the same for (a, b) and (b, a).
std::uint64_t pair_key(const Contact& contact) {
  std::int32_t first = contact.a.value();
  std::int32_t second = contact.b.code();
  if (first < second) std::swap(first, second);
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(first)) << 32) |
         static_cast<std::uint32_t>(second);
}

}  // namespace

std::optional<Defect> find_defect(const Packing& packing) {
  const auto scene = [](std::string reason) { return Defect{PackingPart::kScene, -1, std::move(reason)}; };
  if (auto reason = not_finite("gravity", packing.gravity.sum())) return scene(*reason);
  if (!std::isfinite(packing.named_force_unit) || packing.named_force_unit < 0) {
    return scene(fmt::format("force_unit must be positive, but is {}", packing.named_force_unit));
  }
  for (int i = 0; i < packing.disk_count(); ++i) {
    if (auto reason = disk_defect(packing[DiskId(i)])) return Defect{PackingPart::kDisk, i, *reason};
  }
  for (int i = 0; i < packing.wall_count(); ++i) {
    if (auto reason = wall_defect(packing[WallId(i)])) return Defect{PackingPart::kWall, i, *reason};
  }
  std::unordered_map<std::uint64_t, int> seen;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    if (auto reason = contact_defect(packing, contact)) return Defect{PackingPart::kContact, i, *reason};
    const auto [earlier, is_new] = seen.emplace(pair_key(contact), i);
    if (!is_new) {
      return Defect{PackingPart::kContact, i,
                    fmt::format("this contact is given twice: it is also contact {}", earlier->second)};
    }
  }
  try {
    static_cast<void>(packing.force_unit());
  } catch (const InputError& error) {
    return scene(error.what());
  }
  return {};
}

void validate(const Packing& packing, const std::string& source) {
  const auto defect = find_defect(packing);
  if (!defect) return;
  const char* part = "";
  switch (defect->part) {
    case PackingPart::kScene:
      throw InputError(fmt::format("{}: {}", source, defect->reason));
    case PackingPart::kDisk:
      part = "disk";
      break;
    case PackingPart::kWall:
      part = "wall";
      break;
    case PackingPart::kContact:
      part = "contact";
      break;
  }
  throw InputError(fmt::format("{}: {} {}: {}", source, part, defect->index, defect->reason));
}

}  // namespace indet
