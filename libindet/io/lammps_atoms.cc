#include "libindet/io/lammps_atoms.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <unordered_map>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// A coordinate along one axis, from whichever column has it.
class Coordinate {
 public:
  Coordinate(const DumpFrame& frame, const std::string& name, bool is_named, int axis)
      : table_(frame.table), name_(name) {
    const std::string letter(1, Plane::letter(axis));
    if (is_named || table_.has(name)) {
      table_.require({name});
    } else if (table_.has(letter + "u")) {
      name_ = letter + "u";
    } else if (table_.has(letter + "s")) {
      name_ = letter + "s";
      if (frame.tilted) {
        throw InputError(fmt::format("{}: {} is relative to a tilted box; dump the coordinates {}",
                                     table_.source(), name_, letter));
      }
      const auto i = static_cast<std::size_t>(axis);
      low_ = frame.low[i];
      length_ = frame.high[i] - low_;
    } else {
      table_.require({name});
    }
  }

  double operator()(int row) const { return low_ + length_ * table_.number(row, name_); }

 private:
  const Table& table_;
  std::string name_;
  double low_ = 0, length_ = 1;
};

/// All centres must lie in one plane.
void require_one_plane(const Table& table, const Plane& plane, const std::vector<int>& rows,
                       const Packing& packing) {
  const std::string letter(1, Plane::letter(plane.normal));
  if (!table.has(letter)) return;
  const double first = table.number(rows.front(), letter);
  for (const int row : rows) {
    if (std::abs(table.number(row, letter) - first) <= tolerance::kSameWall * packing.max_radius()) continue;
    table.fail(
        row, letter,
        fmt::format("the atom lies at {}, the first one at {}; only packings in one plane {} can be read",
                    table.text(row, letter), table.text(rows.front(), letter), plane.name()));
  }
}

}  // namespace

std::vector<int> read_lammps_atoms(const DumpFrame& frame, const LammpsColumns& names, const Plane& plane,
                                   PackingBuilder& builder) {
  const Table& table = frame.table;
  const bool diameters = !names.is_named("radius") &&
                         (names.is_named("diameter") || !table.has(names["radius"])) &&
                         table.has(names["diameter"]);
  table.require({names["id"], diameters ? names["diameter"] : names["radius"], names["mass"]});
  const Coordinate x(frame, names["x"], names.is_named("x"), plane.first);
  const Coordinate y(frame, names["y"], names.is_named("y"), plane.second);
  std::unordered_map<std::int32_t, int> row_of_id;
  for (int row = 0; row < table.rows(); ++row) {
    Disk disk;
    disk.id = table.integer(row, names["id"]);
    row_of_id.emplace(disk.id, row);
    disk.position = {x(row), y(row)};
    disk.radius = diameters ? 0.5 * table.number(row, names["diameter"]) : table.number(row, names["radius"]);
    disk.mass = table.number(row, names["mass"]);
    disk.inertia = 0.5 * disk.mass * disk.radius * disk.radius;
    disk.velocity = {table.number_or(row, names["vx"], 0), table.number_or(row, names["vy"], 0)};
    disk.angular_velocity = plane.turned(table.number_or(row, names["omegaz"], 0));
    builder.add_disk(disk, table.is_empty(row, names["type"]) ? -1 : table.integer(row, names["type"]),
                     place_of(table, row));
  }
  builder.close_disks();
  std::vector<int> rows;
  for (const Disk& disk : builder.packing().disks) rows.push_back(row_of_id.at(disk.id));
  require_one_plane(table, plane, rows, builder.packing());
  return rows;
}

}  // namespace indet
