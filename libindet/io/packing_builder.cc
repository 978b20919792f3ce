#include "libindet/io/packing_builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "libindet/base/constants.h"
#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"

namespace indet {
namespace {

bool same_force(const Contact& first, const Contact& second) {
  const double allowed = tolerance::kPrintedForce * std::hypot(first.R, first.T);
  return std::hypot(first.R - second.R, first.T - second.T) <= allowed;
}

bool says_nothing(const Contact& contact) { return contact.gap > 0 && contact.R == 0 && contact.T == 0; }

}  // namespace

void Place::fail(const std::string& reason) const {
  throw InputError(line > 0 ? fmt::format("{}:{}: {}", source, line, reason)
                            : fmt::format("{}: {}", source, reason));
}

PackingBuilder::PackingBuilder(std::string protocol, std::string noun, std::string source,
                               const ImportSettings& settings)
    : noun_(std::move(noun)), source_(std::move(source)), settings_(settings) {
  packing_.origin.protocol = std::move(protocol);
  packing_.named_force_unit = settings.force_unit;
}

void PackingBuilder::add_disk(const Disk& disk, int type, const Place& place) {
  found_disks_.push_back({disk, type, place});
}

void PackingBuilder::close_disks() {
  if (found_disks_.empty()) throw InputError(fmt::format("{}: there is no {} in it", source_, noun_));
  std::stable_sort(
      found_disks_.begin(), found_disks_.end(),
      [](const FoundDisk& left, const FoundDisk& right) { return left.disk.id < right.disk.id; });
  for (FoundDisk& found : found_disks_) {
    const int index = packing_.disk_count();
    found.disk.fixed |= settings_.fixed.names(found.disk.id, found.type);
    if (!index_of_id_.emplace(found.disk.id, index).second) {
      found.place.fail(fmt::format("{} {} is given twice", noun_, found.disk.id));
    }
    packing_.disks.push_back(found.disk);
    types_.push_back(found.type);
    disk_places_.push_back(found.place);
  }
  found_disks_.clear();
  check_fixed_names();
  if (packing_.free_disk_count() == 0) {
    throw InputError(
        fmt::format("{}: all its {} are fixed, so that there is nothing to balance", source_, plural()));
  }
  const auto defect = find_defect(packing_);
  if (defect && defect->part == PackingPart::kDisk) {
    disk_places_[static_cast<std::size_t>(defect->index)].fail(defect->reason);
  }
}

void PackingBuilder::check_fixed_names() const {
  std::vector<std::pair<std::int32_t, int>> disks;
  for (int i = 0; i < packing_.disk_count(); ++i) disks.emplace_back(packing_[DiskId(i)].id, type(DiskId(i)));
  const std::string idle = settings_.fixed.idle_item(disks);
  if (idle.empty()) return;
  const bool no_types = idle.starts_with("type=") && std::count(types_.begin(), types_.end(), -1) > 0;
  throw InputError(fmt::format("{}: no {} is fixed by \"{}\"{}", source_, noun_, idle,
                               no_types ? "; the file has no types" : ""));
}

WallId PackingBuilder::add_wall(Wall wall, const std::vector<std::string>& names, const Place& place) {
  wall_names_.push_back(names);
  wall_names_.back().insert(wall_names_.back().begin(), wall.name);
  wall_places_.push_back(place);
  packing_.walls.push_back(std::move(wall));
  return WallId(packing_.wall_count() - 1);
}

std::optional<DiskId> PackingBuilder::find_disk(std::int32_t id) const {
  const auto found = index_of_id_.find(id);
  if (found == index_of_id_.end()) return {};
  return DiskId(found->second);
}

DiskId PackingBuilder::disk(std::int32_t id, const Place& place) const {
  const auto found = find_disk(id);
  if (!found) place.fail(fmt::format("{} {} is not in {}", noun_, id, source_));
  return *found;
}

Contact PackingBuilder::contact(DiskId a, Body b, const Place& place) const {
  if (b == Body::disk(a) && !packing_.cell.is_periodic())
    place.fail(fmt::format("{} {} cannot touch itself", noun_, packing_[a].id));
  Contact contact;
  contact.a = a;
  contact.b = b;
  if (!b.is_wall()) contact.image = nearest_image(packing_, a, b.disk_id());
  contact.mu = kNaN;
  try {
    contact.normal = geometric_normal(packing_, a, b, contact.image);
  } catch (const InputError& error) {
    place.fail(error.what());
  }
  contact.gap = geometric_gap(packing_, a, b, contact.image);
  return contact;
}

void PackingBuilder::project(Contact& contact, const Vector2& force) {
  contact.R = force.dot(contact.normal);
  contact.T = force.dot(contact.tangent());
}

std::string PackingBuilder::plural() const {
  return noun_.ends_with('y') ? noun_.substr(0, noun_.size() - 1) + "ies" : noun_ + "s";
}

std::string PackingBuilder::bodies_of(const Contact& contact) const {
  const std::int32_t a = packing_[contact.a].id;
  if (contact.b.is_wall())
    return fmt::format("{} {} and wall {}", noun_, a, packing_[contact.b.wall_id()].name);
  return fmt::format("{} {} and {}", plural(), a, packing_[contact.b.disk_id()].id);
}

void PackingBuilder::add_contact(const Contact& contact, const Place& place) {
  if (!std::isfinite(contact.R) || !std::isfinite(contact.T)) {
    place.fail(fmt::format("the force of {} is not a finite number", bodies_of(contact)));
  }
  const double reach =
      packing_[contact.a].radius + (contact.b.is_wall() ? 0 : packing_[contact.b.disk_id()].radius);
  if (contact.gap > tolerance::kPushingDistance * reach && (contact.R != 0 || contact.T != 0)) {
    place.fail(fmt::format("{} push each other, but their surfaces are {:.3g} apart; {}", bodies_of(contact),
                           contact.gap,
                           periodic_ ? "contacts across a periodic boundary are not supported"
                                     : "do positions and contacts belong together?"));
  }
  if (!packing_.has_equations(contact.a) && !packing_.has_equations(contact.b)) {
    ++imported_.without_equations;
    return;
  }
  const auto [earlier, is_new] = first_.emplace(contact_key(contact), FoundContact{contact, place});
  if (!is_new) {
    const FoundContact& before = earlier->second;
    if (!same_force(before.contact, contact)) {
      place.fail(fmt::format("the contact of {} is given twice, first in line {}, with another force",
                             bodies_of(contact), before.place.line));
    }
    ++imported_.duplicates;
    repeated_place_ = place;
    return;
  }
  if (says_nothing(contact)) {
    ++apart_;
    apart_place_ = place;
  } else {
    contacts_.push_back({contact, place});
  }
}

void PackingBuilder::set_friction() {
  for (FoundContact& found : contacts_) {
    Contact& contact = found.contact;
    const bool wall = contact.b.is_wall();
    const auto mu =
        wall ? settings_.friction.of_wall(wall_names_[static_cast<std::size_t>(contact.b.wall_id().value())])
             : settings_.friction.of_disks(type(contact.a), type(contact.b.disk_id()));
    if (mu) contact.mu = *mu;
    if (std::isnan(contact.mu)) {
      found.place.fail(fmt::format("the friction of {} is not known: give it with --friction MU or {}",
                                   bodies_of(contact), wall ? "wall=MU" : "disk=MU"));
    }
  }
}

void PackingBuilder::check_friction_names() const {
  for (const auto& [name, unused] : settings_.friction.walls()) {
    const bool known = std::any_of(wall_names_.begin(), wall_names_.end(), [&name = name](const auto& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    });
    if (known) continue;
    std::vector<std::string> names;
    for (const Wall& wall : packing_.walls) names.push_back(wall.name);
    throw InputError(fmt::format("{}: there is no wall {} to have a friction; {}", source_, name,
                                 names.empty() ? "there are no walls at all"
                                               : fmt::format("the walls are {}", fmt::join(names, ", "))));
  }
  for (const auto& [types, unused] : settings_.friction.types()) {
    for (const int type : {types.first, types.second}) {
      if (std::find(types_.begin(), types_.end(), type) != types_.end()) continue;
      throw InputError(fmt::format("{}: there is no {} of type {} to have a friction", source_, noun_, type));
    }
  }
}

void PackingBuilder::sort_contacts() {
  // Contacts of two disks first, then wall by wall.
  const auto key = [](const FoundContact& found) {
    const Contact& c = found.contact;
    return c.b.is_wall() ? std::tuple(1, c.b.wall_id().value(), c.a.value(), c.image)
                         : std::tuple(0, c.a.value(), c.b.code(), c.image);
  };
  std::sort(contacts_.begin(), contacts_.end(),
            [&](const FoundContact& left, const FoundContact& right) { return key(left) < key(right); });
  for (const FoundContact& found : contacts_) packing_.contacts.push_back(found.contact);
}

void PackingBuilder::find_defects() const {
  const auto defect = find_defect(packing_);
  if (!defect) return;
  const auto index = static_cast<std::size_t>(defect->index);
  switch (defect->part) {
    case PackingPart::kScene:
      throw InputError(fmt::format("{}: {}", source_, defect->reason));
    case PackingPart::kCell:
      throw InputError(fmt::format("{}: the periodic box: {}", source_, defect->reason));
    case PackingPart::kStress:
      throw InputError(fmt::format("{}: stress: {}", source_, defect->reason));
    case PackingPart::kDisk:
      disk_places_[index].fail(defect->reason);
    case PackingPart::kWall:
      wall_places_[index].fail(defect->reason);
    case PackingPart::kContact:
      contacts_[index].place.fail(defect->reason);
  }
}

void PackingBuilder::warn_of_what_was_left_out() {
  if (imported_.duplicates > 0) {
    warn(fmt::format("{}: {} given twice with the same force, and taken once", repeated_place_.source,
                     counted(imported_.duplicates, "contact is", "contacts are")));
  }
  if (apart_ > 0) {
    warn(fmt::format("{}: left out {}, which neither touch nor transmit a force", apart_place_.source,
                     counted(apart_, "pair of " + plural(), "pairs of " + plural())));
  }
  const auto idle = std::count_if(packing_.contacts.begin(), packing_.contacts.end(),
                                  [](const Contact& c) { return c.R == 0 && c.T == 0; });
  if (idle > 0) {
    warn(fmt::format(
        "{}: kept {}, which transmit no force", contacts_.front().place.source,
        counted(idle, "contact whose " + plural() + " touch", "contacts whose " + plural() + " touch")));
  }
}

void PackingBuilder::drop_idle_directions() {
  for (const int k : {0, 1}) {
    auto& vector = k == 0 ? packing_.cell.a : packing_.cell.b;
    const auto crosses = [&](const Contact& c) { return c.image[static_cast<std::size_t>(k)] != 0; };
    if (!vector || std::any_of(packing_.contacts.begin(), packing_.contacts.end(), crosses)) continue;
    warn(fmt::format(
        "{}: the box is periodic along ({:.6g}, {:.6g}), but no contact crosses that boundary, so "
        "it is left out",
        source_, vector->x(), vector->y()));
    vector.reset();
  }
}

void PackingBuilder::require_force_unit() const {
  if (!packing_.gravity.isZero() || settings_.force_unit > 0) return;
  std::string example;
  if (packing_.cell.is_full() && packing_.has_simulated_forces()) {
    const Eigen::Matrix2d stress = contact_stress(packing_, packing_.simulated_forces());
    example = fmt::format("; the pressure times the largest diameter is {:.3g}",
                          std::abs(stress.trace()) * packing_.max_radius());
  }
  throw InputError(
      fmt::format("{}: there is no gravity, so that no mean weight can be the unit of printed forces; name a "
                  "unit with --force-unit F (the choice does not change the ranges){}",
                  source_, example));
}

ImportedPacking PackingBuilder::build(const std::optional<Vector2>& gravity) {
  check_friction_names();
  set_friction();
  sort_contacts();
  drop_idle_directions();
  const Vector2 fallback(0, packing_.cell.is_full() ? 0 : -1);
  packing_.gravity = settings_.gravity.value_or(gravity.value_or(fallback));
  require_force_unit();
  find_defects();
  warn_of_what_was_left_out();
  warn_of_large_gaps(imported_);
  imported_.types = std::move(types_);
  return std::move(imported_);
}

}  // namespace indet
