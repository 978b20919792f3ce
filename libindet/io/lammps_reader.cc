#include "libindet/io/lammps_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/io/import_format.h"
#include "libindet/io/lammps_atoms.h"
#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_dump.h"
#include "libindet/io/lammps_walls.h"
#include "libindet/io/lammps_warnings.h"
#include "libindet/io/packing_builder.h"

namespace indet {
namespace {

/// Adds the contacts of two disks. Returns the largest tangential part of a normal force, or normal part of a
/// tangential one.
double read_pairs(const Table& table, const LammpsColumns& names, PackingBuilder& builder) {
  table.require({names["atom1"], names["atom2"], names["fx"], names["fy"], names["p1"], names["p2"]});
  const bool has_friction = names.is_named("mu");
  if (has_friction) table.require({names["mu"]});
  double odd_parts = 0;
  for (int row = 0; row < table.rows(); ++row) {
    const Place place = place_of(table, row);
    const DiskId a = builder.disk(table.integer(row, names["atom1"]), place);
    const DiskId b = builder.disk(table.integer(row, names["atom2"]), place);
    Contact contact = builder.contact(a, Body::disk(b), place);
    const Vector2 normal_force{table.number(row, names["fx"]), table.number(row, names["fy"])};
    const Vector2 tangential_force{table.number(row, names["p1"]), table.number(row, names["p2"])};
    PackingBuilder::project(contact, normal_force + tangential_force);
    if (has_friction) contact.mu = table.number(row, names["mu"]);
    odd_parts = std::max({odd_parts, std::abs(normal_force.dot(contact.tangent())),
                          std::abs(tangential_force.dot(contact.normal))});
    builder.add_contact(contact, place);
  }
  return odd_parts;
}

}  // namespace

ImportedPacking read_lammps(const DumpFiles& files, const ImportSettings& settings) {
  const LammpsColumns names(settings.columns, settings.plane);
  if (names.is_named("mu") && settings.friction.covers_disks()) {
    throw InputError(
        fmt::format("column {} has the friction of two disks, so only that of walls can be given: "
                    "wall=MU or wall:NAME=MU",
                    names["mu"]));
  }
  const DumpPair dumps = read_dumps(files);
  PackingBuilder builder("import lammps", "atom", files.atoms.string(), settings);
  const std::vector<int> rows = read_lammps_atoms(dumps.atoms, names, settings.plane, builder);
  builder.set_cell(dumps.cell(settings.plane));
  const double odd_parts = read_pairs(dumps.contacts.table, names, builder);
  read_lammps_walls(dumps.atoms, names, settings.plane, rows, builder);
  ImportedPacking imported = builder.build({});
  warn_of_rounding(imported, dumps, names, odd_parts);
  warn_of_atoms_outside(imported, dumps.atoms, settings.plane);
  return imported;
}

ImportFormat lammps_format() {
  return {.name = "lammps",
          .input = "",
          .options = {"--atoms", "--contacts", "--timestep", "--friction", "--gravity", "--columns",
                      "--fixed", "--force-unit", "--plane"},
          .documented = {Lever::kRadius, Lever::kRadius},
          .lacks_friction = "a LAMMPS dump does not contain the friction coefficient",
          .files = [](const ImportRequest& request) -> std::vector<std::filesystem::path> {
            return {request.dumps.atoms, request.dumps.contacts};
          },
          .read = [](const ImportRequest& request) { return read_lammps(request.dumps, request.settings); }};
}

}  // namespace indet
