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

/// Few printed digits, and parts of forces that the projections drop.
void warn_of_rounding(ImportedPacking& imported, const LammpsOptions& options, const LammpsColumns& names,
                      const Table& atoms, double discarded) {
  const Packing& packing = imported.packing;
  int digits = 0;
  for (int row = 0; row < atoms.rows(); ++row) {
    digits = std::max({digits, significant_digits(atoms.text(row, names["x"])),
                       significant_digits(atoms.text(row, names["y"]))});
  }
  // Fewer than four digits are no format but a scene made by hand.
  if (digits >= 4 && digits <= 12) {
    imported.rounding = 0.5 * std::pow(10.0, 1 - digits);
    warn(imported, fmt::format("{}: numbers have only {} digits, which limits the balance of forces; {}",
                               options.atoms.string(), digits, kFormatHint));
  }
  const double unit = packing.force_unit();
  double largest = unit;
  for (const Contact& contact : packing.contacts) largest = std::max(largest, std::abs(contact.R));
  if (discarded > std::max(tolerance::kDiscardedForce * unit, 1e3 * imported.rounding * largest)) {
    warn(imported,
         fmt::format("{}: the normal force ({}, {}) has tangential parts or the tangential force ({}, {}) "
                     "normal ones, up to {:.3g} mg, which are ignored; are the columns the right ones?",
                     options.contacts.string(), names["fx"], names["fy"], names["p1"], names["p2"],
                     discarded / unit));
  }
}

void warn_of_atoms_outside(ImportedPacking& imported, const LammpsOptions& options, const DumpFrame& atoms) {
  const Packing& packing = imported.packing;
  std::set<int> outside;
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Vector2& position = packing[DiskId(i)].position;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double x = position[static_cast<Eigen::Index>(axis)];
      if (atoms.low[axis] < atoms.high[axis] && (x < atoms.low[axis] || x > atoms.high[axis])) {
        outside.insert(i);
      }
    }
    for (const Wall& wall : packing.walls) {
      if ((position - wall.point).dot(wall.normal) < 0) outside.insert(i);
    }
  }
  if (outside.empty()) return;
  warn(imported,
       fmt::format("{}: {} outside the box or behind a wall; the first is atom {}", options.atoms.string(),
                   counted(static_cast<std::int64_t>(outside.size()), "atom is", "atoms are"),
                   packing[DiskId(*outside.begin())].id));
}

void warn_of_contacts_without_force(ImportedPacking& imported, const LammpsOptions& options, int apart) {
  const Packing& packing = imported.packing;
  if (imported.duplicates > 0) {
    warn(imported,
         fmt::format("{}: {} given twice with the same force, and taken once", options.contacts.string(),
                     counted(imported.duplicates, "contact is", "contacts are")));
  }
  if (apart > 0) {
    warn(imported,
         fmt::format("{}: left out {}, which neither touch nor transmit a force (\"cutoff radius\" in the "
                     "computes of LAMMPS would do the same)",
                     options.contacts.string(), counted(apart, "pair of atoms", "pairs of atoms")));
  }
  const auto idle = std::count_if(packing.contacts.begin(), packing.contacts.end(),
                                  [](const Contact& c) { return c.R == 0 && c.T == 0; });
  if (idle > 0) {
    warn(imported, fmt::format("{}: kept {}, which transmit no force", options.contacts.string(),
                               counted(idle, "contact whose atoms touch", "contacts whose atoms touch")));
  }
}

}  // namespace

void warn_of_oddities(ImportedPacking& imported, const LammpsOptions& options, const LammpsColumns& columns,
                      const DumpFrame& atoms, const LammpsRemainder& remainder) {
  warn_of_rounding(imported, options, columns, atoms.table, remainder.discarded);
  warn_of_atoms_outside(imported, options, atoms);
  warn_of_contacts_without_force(imported, options, remainder.apart);
  warn_of_large_gaps(imported);
}

}  // namespace indet
