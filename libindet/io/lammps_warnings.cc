#include "libindet/io/lammps_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "libindet/base/counted.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

constexpr const char* kFormatHint = "write it with: dump_modify ID format float %.17g";

/// Number of significant digits of a printed number.
int significant_digits(std::string_view text) {
  int digits = 0;
  for (const char c : text.substr(0, text.find_first_of("eE"))) {
    if (c >= '0' && c <= '9' && (digits > 0 || c != '0')) ++digits;
  }
  return digits;
}

void warn(ImportedPacking& imported, std::string text) { imported.warnings.push_back(std::move(text)); }

}  // namespace

void warn_of_rounding(ImportedPacking& imported, const DumpPair& dumps, const LammpsColumns& names,
                      double odd_parts) {
  const Packing& packing = imported.packing;
  const Table& atoms = dumps.atoms.table;
  int digits = 0;
  for (const std::string& column : {names["x"], names["y"]}) {
    if (!atoms.has(column)) continue;
    for (int row = 0; row < atoms.rows(); ++row) {
      digits = std::max(digits, significant_digits(atoms.text(row, column)));
    }
  }
  // Fewer than four digits are no format but a scene made by hand.
  if (digits >= 4 && digits <= 12) {
    imported.rounding = 0.5 * std::pow(10.0, 1 - digits);
    warn(imported, fmt::format("{}: numbers have only {} digits, which limits the balance of forces; {}",
                               atoms.source(), digits, kFormatHint));
  }
  const double unit = packing.force_unit();
  double largest = unit;
  for (const Contact& contact : packing.contacts) largest = std::max(largest, std::abs(contact.R));
  if (odd_parts > std::max(tolerance::kDiscardedForce * unit, 1e3 * imported.rounding * largest)) {
    warn(imported,
         fmt::format("{}: the normal force ({}, {}) has tangential parts or the tangential force ({}, {}) "
                     "normal ones, up to {:.3g} mg; are the columns the right ones?",
                     dumps.contacts.table.source(), names["fx"], names["fy"], names["p1"], names["p2"],
                     odd_parts / unit));
  }
}

void warn_of_atoms_outside(ImportedPacking& imported, const DumpFrame& atoms, const Plane& plane) {
  const Packing& packing = imported.packing;
  std::set<int> outside;
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Vector2& position = packing[DiskId(i)].position;
    const auto is_outside = [&](double x, int axis) {
      const double low = atoms.low[static_cast<std::size_t>(axis)];
      const double high = atoms.high[static_cast<std::size_t>(axis)];
      const bool periodic = atoms.periodic[static_cast<std::size_t>(axis)];  // an image is inside
      return !periodic && low < high && (x < low || x > high);
    };
    if (is_outside(position.x(), plane.first) || is_outside(position.y(), plane.second)) outside.insert(i);
    for (const Wall& wall : packing.walls) {
      if ((position - wall.point).dot(wall.normal) < 0) outside.insert(i);
    }
  }
  if (outside.empty()) return;
  warn(imported,
       fmt::format("{}: {} outside the box or behind a wall; the first is atom {}", atoms.table.source(),
                   counted(static_cast<std::int64_t>(outside.size()), "atom is", "atoms are"),
                   packing[DiskId(*outside.begin())].id));
}

}  // namespace indet
