#pragma once

#include <array>
#include <span>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet {

/// Which equations of bodies the scene needs, numbered; −1 where an equation is left out: those of disks
/// (force x, force y, torque), of loaded walls (along normal and tangent), of the stress on a cell (xx, yy,
/// xy, pressure).
class RowNumbering {
 public:
  RowNumbering(const Packing& packing, std::span<const ContactMode> modes, std::span<const Loads> changes,
               const ForceUnits& units);

  int operator()(DiskId disk, int component) const {
    return numbers_[static_cast<std::size_t>(disk.value())][static_cast<std::size_t>(component)];
  }
  int operator()(WallId wall, int component) const {
    return wall_numbers_[static_cast<std::size_t>(wall.value())][static_cast<std::size_t>(component)];
  }
  int of_cell(int component) const { return cell_numbers_[static_cast<std::size_t>(component)]; }
  const std::vector<EquilibriumRow>& rows() const { return rows_; }

 private:
  void number_stress(const Packing& packing, std::span<const ContactMode> modes, const ForceUnits& units);

  std::vector<std::array<int, 3>> numbers_;
  std::vector<std::array<int, 2>> wall_numbers_;
  std::array<int, 4> cell_numbers_{};
  std::vector<EquilibriumRow> rows_;
};

}  // namespace indet
