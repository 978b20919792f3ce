#include "libindet/packing/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
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

Reason image_defect(const Cell& cell, const Contact& contact) {
  if (!contact.has_image()) return {};
  if (contact.b.is_wall()) return "body b is a wall, which has no images, so its image must be 0, 0";
  const bool in_a = cell.a || contact.image[0] == 0;
  const bool in_b = cell.b || contact.image[1] == 0;
  if (in_a && in_b) return {};
  return fmt::format("its image is ({}, {}), but the scene is not periodic along the {} vector of a cell",
                     contact.image[0], contact.image[1], in_a ? "second" : "first");
}

Reason vector_defect(const char* name, const std::optional<Vector2>& vector) {
  if (!vector) return {};
  if (!vector->allFinite()) return fmt::format("{} must be two finite numbers", name);
  if (!vector->isZero(0)) return {};
  return fmt::format("{} must not be (0, 0); leave it out where the scene is not periodic", name);
}

Reason cell_defect(const Packing& packing) {
  const Cell& cell = packing.cell;
  if (auto reason = vector_defect("a", cell.a)) return reason;
  if (auto reason = vector_defect("b", cell.b)) return reason;
  if (!cell.is_full()) return {};
  if (!(cell.area() > tolerance::kFlatCell * cell.a->stableNorm() * cell.b->stableNorm()))
    return "its two vectors are parallel, so it has no area";
  if (!packing.gravity.isZero(0) && packing.disk_count() > 0 && packing.fixed_disk_count() == 0)
    return fmt::format(
        "the scene is periodic in both directions and has no fixed disk, so nothing takes the weight of its "
        "disks: gravity must be (0, 0), but is ({}, {})",
        packing.gravity.x(), packing.gravity.y());
  return {};
}

Reason stress_defect(const Packing& packing) {
  const auto components = packing.stress.components();
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (std::isinf(components[k])) return fmt::format("{} must be a finite number", Stress::kNames[k]);
  }
  if (!packing.stress.is_imposed()) return {};
  if (!packing.cell.is_full()) return "a stress needs a cell that is periodic in both directions";
  if (packing.fixed_disk_count() > 0)
    return "a stress cannot be imposed on a cell with fixed disks, which bear a part of it";
  if (const char* reason = packing.stress.contradiction()) return reason;
  return {};
}

/// A wall must look the same in each image of the cell.
Reason wall_in_cell_defect(const Cell& cell, const Wall& wall) {
  if (!cell.is_periodic()) return {};
  if (cell.is_full()) return "a scene that is periodic in both directions has no walls";
  const Vector2& along = cell.a ? *cell.a : *cell.b;
  if (std::abs(along.stableNormalized().dot(wall.normal)) <= tolerance::kNormalDirection) return {};
  return fmt::format("the scene is periodic along ({}, {}), so its walls must be parallel to that", along.x(),
                     along.y());
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
  if (contact.b.is_cell()) return fmt::format("body b is {}, which is no body", contact.b.code());
  if (!contact.b.is_wall() && contact.b.disk_id().value() >= packing.disk_count()) {
    return fmt::format("body b is disk {}, but the disks are 0 … {}", contact.b.code(),
                       packing.disk_count() - 1);
  }
  if (auto reason = image_defect(packing.cell, contact)) return reason;
  if (!contact.b.is_wall() && contact.b.disk_id() == contact.a && !contact.has_image()) {
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
    expected = geometric_normal(packing, contact.a, contact.b, contact.image);
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
  const double gap = geometric_gap(packing, contact.a, contact.b, contact.image);
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

}  // namespace

ContactKey contact_key(const Contact& contact) {
  const std::int64_t i = contact.image[0];
  const std::int64_t j = contact.image[1];
  const std::pair direct{contact.a.value(), contact.b.code()};
  const bool turns =
      direct.first < direct.second || (direct.first == direct.second && (i < 0 || (i == 0 && j < 0)));
  if (!turns) return {direct.first, direct.second, contact.image[0], contact.image[1]};
  return {direct.second, direct.first, static_cast<std::int32_t>(-i), static_cast<std::int32_t>(-j)};
}

std::optional<Defect> find_defect(const Packing& packing) {
  const auto scene = [](std::string reason) { return Defect{PackingPart::kScene, -1, std::move(reason)}; };
  if (auto reason = not_finite("gravity", packing.gravity.sum())) return scene(*reason);
  if (!std::isfinite(packing.named_force_unit) || packing.named_force_unit < 0) {
    return scene(fmt::format("force_unit must be positive, but is {}", packing.named_force_unit));
  }
  if (auto reason = cell_defect(packing)) return Defect{PackingPart::kCell, -1, *reason};
  if (auto reason = stress_defect(packing)) return Defect{PackingPart::kStress, -1, *reason};
  for (int i = 0; i < packing.disk_count(); ++i) {
    if (auto reason = disk_defect(packing[DiskId(i)])) return Defect{PackingPart::kDisk, i, *reason};
  }
  for (int i = 0; i < packing.wall_count(); ++i) {
    auto reason = wall_defect(packing[WallId(i)]);
    if (!reason) reason = wall_in_cell_defect(packing.cell, packing[WallId(i)]);
    if (reason) return Defect{PackingPart::kWall, i, *reason};
  }
  std::map<ContactKey, int> seen;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    if (auto reason = contact_defect(packing, contact)) return Defect{PackingPart::kContact, i, *reason};
    const auto [earlier, is_new] = seen.emplace(contact_key(contact), i);
    if (!is_new) {
      return Defect{PackingPart::kContact, i,
                    fmt::format("this contact is given twice: it is also contact {}", earlier->second)};
    }
  }
  const double unit = packing.force_unit();
  // Their squares are to be numbers.
  constexpr double kLeastUnit = 1e-150;
  constexpr double kMostUnit = 1e150;
  if (!(unit >= kLeastUnit && unit <= kMostUnit)) {
    return scene(
        fmt::format("the unit of force has to be from {} to {}, but is {}; other units of mass, "
                    "length or time bring it there",
                    kLeastUnit, kMostUnit, unit));
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
    case PackingPart::kCell:
      throw InputError(fmt::format("{}: cell: {}", source, defect->reason));
    case PackingPart::kStress:
      throw InputError(fmt::format("{}: stress: {}", source, defect->reason));
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
