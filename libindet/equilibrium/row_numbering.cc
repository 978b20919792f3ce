#include "libindet/equilibrium/row_numbering.h"

#include <algorithm>
#include <cmath>

namespace indet {

RowNumbering::RowNumbering(const Packing& packing, std::span<const ContactMode> modes,
                           std::span<const Loads> changes, const ForceUnits& units)
    : numbers_(packing.disks.size(), {-1, -1, -1}), wall_numbers_(packing.walls.size(), {-1, -1}) {
  cell_numbers_.fill(-1);
  std::vector<std::array<bool, 3>> needed(packing.disks.size(), {false, false, false});
  std::vector<std::array<bool, 2>> needed_of_wall(packing.walls.size(), {false, false});
  const auto touch = [&](DiskId disk, bool turns) {
    if (!packing.has_equations(disk)) return;
    auto& components = needed[static_cast<std::size_t>(disk.value())];
    components[0] = components[1] = true;
    components[2] = components[2] || turns;
  };
  for (int i = 0; i < packing.contact_count(); ++i) {
    const ContactMode mode = modes[static_cast<std::size_t>(i)];
    const Contact& contact = packing[ContactId(i)];
    if (mode == ContactMode::kOpen) continue;
    const bool turns = mode != ContactMode::kFrictionless;
    touch(contact.a, turns);
    if (contact.b.is_wall()) {
      auto& components = needed_of_wall[static_cast<std::size_t>(contact.b.wall_id().value())];
      components[0] = true;
      components[1] = components[1] || turns;
    } else {
      touch(contact.b.disk_id(), turns);
    }
  }
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Vector3 wrench = packing.wrench(DiskId(i));
    const Disk& disk = packing[DiskId(i)];
    for (int k = 0; k < 3; ++k) {
      const auto number = static_cast<std::size_t>(i);
      const auto component = static_cast<std::size_t>(k);
      const bool changes_load = std::any_of(changes.begin(), changes.end(), [&](const Loads& change) {
        return change.wrench(packing, DiskId(i))[k] != 0;
      });
      if (!needed[number][component] && wrench[k] == 0 && !changes_load) continue;
      numbers_[number][component] = static_cast<int>(rows_.size());
      const double weight = k < 2 ? std::abs(disk.mass * packing.gravity[k]) : 0;
      rows_.push_back({Body::disk(DiskId(i)), k, units.internal_in_scene() * (k < 2 ? 1 : disk.radius),
                       weight + std::abs(disk.load[k])});
    }
  }
  for (int w = 0; w < packing.wall_count(); ++w) {
    const Wall& wall = packing[WallId(w)];
    for (int k = 0; k < 2; ++k) {
      const double load = k == 0 ? wall.load_n : wall.load_t;
      const auto number = static_cast<std::size_t>(w);
      const auto component = static_cast<std::size_t>(k);
      const bool changes_load = std::any_of(changes.begin(), changes.end(), [&](const Loads& change) {
        return change.on_wall(WallId(w), k) != 0;
      });
      if (std::isnan(load) || (!needed_of_wall[number][component] && load == 0 && !changes_load)) continue;
      wall_numbers_[number][component] = static_cast<int>(rows_.size());
      rows_.push_back({Body::wall(WallId(w)), k, units.internal_in_scene(), std::abs(load)});
    }
  }
  if (packing.stress.is_imposed()) number_stress(packing, modes, units);
}

void RowNumbering::number_stress(const Packing& packing, std::span<const ContactMode> modes,
                                 const ForceUnits& units) {
  const bool carries =
      std::any_of(modes.begin(), modes.end(), [](ContactMode mode) { return mode != ContactMode::kOpen; });
  const auto stress = packing.stress.components();
  for (std::size_t k = 0; k < stress.size(); ++k) {
    if (std::isnan(stress[k]) || (!carries && stress[k] == 0)) continue;
    cell_numbers_[k] = static_cast<int>(rows_.size());
    rows_.push_back({Body::cell(), static_cast<int>(k), units.internal_in_scene() * packing.cell_length(),
                     packing.cell.area() * std::abs(stress[k])});
  }
}

}  // namespace indet
