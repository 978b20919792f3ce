#include "libindet/io/liggghts_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/import_format.h"
#include "libindet/io/in_plane.h"
#include "libindet/io/lammps_atoms.h"
#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_warnings.h"
#include "libindet/io/packing_builder.h"

namespace indet {
namespace {

/// The prefix of the columns of the compute: the only one with a fourth … sixth column.
std::string find_compute(const Table& table) {
  for (const std::string& column : table.columns()) {
    if (!column.ends_with("[1]")) continue;
    const std::string prefix = column.substr(0, column.size() - 3);
    if (table.has(prefix + "[6]")) return prefix;
  }
  table.require({"c_NAME[1]", "c_NAME[6]"});
  return "";
}

std::string column_of(const std::string& prefix, int i) { return fmt::format("{}[{}]", prefix, i); }

/// The force in three columns of a row.
Vector2 force_of(const Table& table, int row, const std::string& prefix, int first, const Plane& plane) {
  Eigen::Vector3d force;
  for (int axis = 0; axis < 3; ++axis) force[axis] = table.number(row, column_of(prefix, first + axis));
  return in_plane(force, plane, place_of(table, row), "the force of " + prefix);
}

void read_pairs(const Table& table, const Plane& plane, PackingBuilder& builder) {
  const std::string prefix = find_compute(table);
  for (int row = 0; row < table.rows(); ++row) {
    const Place place = place_of(table, row);
    const auto atom = [&](int i) {  // ids are printed like all other numbers of the compute
      const double id = table.number(row, column_of(prefix, i));
      if (id != std::floor(id) || std::abs(id) > 1e9) place.fail(fmt::format("{} is no id of an atom", id));
      return builder.disk(static_cast<std::int32_t>(id), place);
    };
    if (table.number(row, column_of(prefix, 3)) != 0) {
      place.fail("the contact lies across a periodic boundary, which is not supported");
    }
    Contact contact = builder.contact(atom(1), Body::disk(atom(2)), place);
    PackingBuilder::project(contact, force_of(table, row, prefix, 4, plane));
    builder.add_contact(contact, place);
  }
}

/// Names of the fixes whose forces the dump has: NAME of f_force_NAME[1].
std::vector<std::string> force_fixes(const Table& table) {
  std::vector<std::string> names;
  for (const std::string& column : table.columns()) {
    if (column.starts_with("f_force_") && column.ends_with("[1]"))
      names.push_back(column.substr(8, column.size() - 11));
  }
  return names;
}

void read_wall(const std::string& name, const GivenWall& given, const Table& table, const Plane& plane,
               const std::vector<int>& rows, PackingBuilder& builder) {
  const std::string prefix = "f_force_" + name;
  const Packing& packing = builder.packing();
  std::optional<WallId> wall;
  for (int i = 0; i < packing.disk_count(); ++i) {
    const int row = rows[static_cast<std::size_t>(i)];
    const Vector2 force = force_of(table, row, prefix, 1, plane);
    if (force.isZero(0)) continue;
    const Place place = place_of(table, row);
    const double side = packing[DiskId(i)].position[given.axis] - given.position > 0 ? 1 : -1;
    Vector2 normal(0, 0);
    normal[given.axis] = side;
    if (!wall) {
      Vector2 point(0, 0);
      point[given.axis] = given.position;
      wall = builder.add_wall({.id = packing.wall_count(), .point = point, .normal = normal, .name = name},
                              {}, place);
    }
    if (packing[*wall].normal != normal) {
      place.fail(
          fmt::format("atom {} touches wall {} from the other side than those before it; is its plane {}?",
                      packing[DiskId(i)].id, name, given.text));
    }
    Contact contact = builder.contact(DiskId(i), Body::wall(*wall), place);
    const double radius = packing[DiskId(i)].radius;
    if (contact.gap > tolerance::kPushingDistance * radius || contact.gap < -radius) {
      place.fail(
          fmt::format("wall {} pushes atom {}, but there is {:.3g} between their surfaces; is its plane {}?",
                      name, packing[DiskId(i)].id, contact.gap, given.text));
    }
    PackingBuilder::project(contact, force);
    builder.add_contact(contact, place);
  }
}

void read_walls(const Table& table, const GivenWalls& walls, const Plane& plane, const std::vector<int>& rows,
                PackingBuilder& builder) {
  const std::vector<std::string> fixes = force_fixes(table);
  for (const auto& [name, given] : walls) {
    if (std::find(fixes.begin(), fixes.end(), name) == fixes.end()) {
      throw InputError(fmt::format(
          "{}: wall {} has no columns f_force_{}[1…3]; give its fix store_force yes{}", table.source(),
          given.text, name,
          fixes.empty() ? "" : fmt::format(" (the file has those of {})", fmt::join(fixes, ", "))));
    }
  }
  for (const std::string& name : fixes) {
    for (int i = 1; i <= 3; ++i) table.require({column_of("f_force_" + name, i)});
    if (const auto given = walls.find(name); given != walls.end()) {
      read_wall(name, given->second, table, plane, rows, builder);
      continue;
    }
    for (int row = 0; row < table.rows(); ++row) {
      if (force_of(table, row, "f_force_" + name, 1, plane).isZero(0)) continue;
      table.fail(
          row,
          fmt::format("wall {} pushes this atom, but no file says where it is: give its plane with --walls "
                      "{}={}:POSITION",
                      name, name, Plane::letter(plane.first)));
    }
  }
  if (fixes.empty()) {
    builder.warn(fmt::format(
        "{}: no wall was read, so that forces of walls are missing if there are any; give each fix "
        "wall/gran store_force yes, and dump its columns f_force_NAME[*]",
        table.source()));
  }
}

}  // namespace

ImportedPacking read_liggghts(const DumpFiles& files, const GivenWalls& walls,
                              const ImportSettings& settings) {
  const LammpsColumns names(settings.columns, settings.plane);
  for (const char* key : {"atom1", "atom2", "fx", "fy", "p1", "p2", "mu"}) {
    if (!names.is_named(key)) continue;
    throw InputError(fmt::format("--columns: {} of LIGGGHTS has its place in the dump of contacts", key));
  }
  if (names.names_walls()) throw InputError("--columns: walls of LIGGGHTS are given by --walls");
  const DumpPair dumps = read_dumps(files);
  PackingBuilder builder("import liggghts", "atom", files.atoms.string(), settings);
  if (dumps.is_periodic(settings.plane)) builder.set_periodic();
  const std::vector<int> rows = read_lammps_atoms(dumps.atoms, names, settings.plane, builder);
  read_pairs(dumps.contacts.table, settings.plane, builder);
  read_walls(dumps.atoms.table, walls, settings.plane, rows, builder);
  ImportedPacking imported = builder.build({});
  warn_of_rounding(imported, dumps, names, 0);
  warn_of_atoms_outside(imported, dumps.atoms, settings.plane);
  return imported;
}

ImportFormat liggghts_format() {
  return {.name = "liggghts",
          .input = "",
          .options = {"--atoms", "--contacts", "--timestep", "--friction", "--gravity", "--columns",
                      "--fixed", "--force-unit", "--plane", "--walls"},
          .documented = {Lever::kMidOverlap, Lever::kMidOverlap},
          .lacks_friction = "a LIGGGHTS dump does not contain the friction coefficient",
          .files = [](const ImportRequest& request) -> std::vector<std::filesystem::path> {
            return {request.dumps.atoms, request.dumps.contacts};
          },
          .read =
              [](const ImportRequest& request) {
                return read_liggghts(request.dumps, parse_walls(request.walls, request.settings.plane),
                                     request.settings);
              }};
}

}  // namespace indet
