#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet::exact {

/// Number of each equation of each disk and loaded wall, −1 where it would read 0 = 0.
class RowNumbers {
 public:
  explicit RowNumbers(const Packing& packing)
      : numbers_(packing.disks.size(), {-1, -1, -1}), wall_numbers_(packing.walls.size(), {-1, -1}) {
    for (const indet::Contact& contact : packing.contacts) {
      if (packing.has_equations(contact.a)) touch(contact.a, contact.mu > 0);
      if (packing.is_free_disk(contact.b)) touch(contact.b.disk_id(), contact.mu > 0);
      if (!contact.b.is_wall()) continue;
      const Wall& wall = packing[contact.b.wall_id()];
      if (wall.is_free_along_normal()) need(contact.b.wall_id(), 0);
      if (wall.is_free_along_tangent() && contact.mu > 0) need(contact.b.wall_id(), 1);
    }
    const auto stress = packing.stress.components();
    for (std::size_t k = 0; k < stress.size(); ++k) {
      if (!std::isnan(stress[k]) && (!packing.contacts.empty() || stress[k] != 0))
        cell_numbers_[k] = count_++;
    }
  }
  int operator()(DiskId disk, int component) const {
    return numbers_[static_cast<std::size_t>(disk.value())][static_cast<std::size_t>(component)];
  }
  int& need(DiskId disk, int component) {
    int& number = numbers_[static_cast<std::size_t>(disk.value())][static_cast<std::size_t>(component)];
    if (number < 0) number = count_++;
    return number;
  }
  int operator()(WallId wall, int component) const {
    return wall_numbers_[static_cast<std::size_t>(wall.value())][static_cast<std::size_t>(component)];
  }
  int& need(WallId wall, int component) {
    int& number = wall_numbers_[static_cast<std::size_t>(wall.value())][static_cast<std::size_t>(component)];
    if (number < 0) number = count_++;
    return number;
  }
  int of_cell(int component) const { return cell_numbers_[static_cast<std::size_t>(component)]; }
  const std::array<int, 4>& of_cell() const { return cell_numbers_; }
  int count() const { return count_; }
  const std::vector<std::array<int, 3>>& all() const { return numbers_; }
  const std::vector<std::array<int, 2>>& of_walls() const { return wall_numbers_; }

 private:
  void touch(DiskId disk, bool turns) {
    need(disk, 0);
    need(disk, 1);
    if (turns) need(disk, 2);
  }
  std::vector<std::array<int, 3>> numbers_;
  std::vector<std::array<int, 2>> wall_numbers_;
  std::array<int, 4> cell_numbers_{-1, -1, -1, -1};
  int count_ = 0;
};

}  // namespace indet::exact
