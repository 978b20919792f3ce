#include "libindet/io/csv_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/csv_table.h"
#include "libindet/io/csv_writer.h"
#include "libindet/io/import_format.h"
#include "libindet/io/scene_file.h"
#include "libindet/packing/cancelling_loads.h"
#include "libindet/packing/force_bounds.h"
#include "libindet/packing/validate.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

/// 0 or 1; empty: 0.
bool flag(const Table& table, int row, const char* column) {
  if (table.is_empty(row, column)) return false;
  const double value = table.number(row, column);
  if (value != 0 && value != 1) table.fail(row, column, fmt::format("must be 0 or 1, but is {}", value));
  return value == 1;
}

/// The row of each id.
using IdMap = std::unordered_map<std::int32_t, int>;

std::int32_t unique_id(const Table& table, int row, IdMap& ids) {
  const std::int32_t id = table.integer(row, "id");
  if (id < 0) table.fail(row, "id", fmt::format("{} is negative; ids count from 0 up", id));
  const auto [earlier, is_new] = ids.emplace(id, row);
  if (!is_new) {
    table.fail(row, "id",
               fmt::format("{} is given twice, first in line {}", id, table.line(earlier->second)));
  }
  return id;
}

std::vector<Disk> read_disks(const Table& table, IdMap& ids) {
  table.require({"id", "x", "y", "radius", "mass"});
  table.allow_only({"id", "x", "y", "radius", "mass", "inertia", "angle", "vx", "vy", "omega", "fx", "fy",
                    "torque", "fixed"});
  std::vector<Disk> disks;
  for (int row = 0; row < table.rows(); ++row) {
    Disk disk;
    disk.id = unique_id(table, row, ids);
    disk.position = {table.number(row, "x"), table.number(row, "y")};
    disk.radius = table.number(row, "radius");
    disk.fixed = flag(table, row, "fixed");
    disk.mass = disk.fixed ? table.number_or(row, "mass", 0) : table.number(row, "mass");
    disk.inertia = table.number_or(row, "inertia", 0.5 * disk.mass * disk.radius * disk.radius);
    disk.angle = table.number_or(row, "angle", 0);
    disk.velocity = {table.number_or(row, "vx", 0), table.number_or(row, "vy", 0)};
    disk.angular_velocity = table.number_or(row, "omega", 0);
    disk.load = {table.number_or(row, "fx", 0), table.number_or(row, "fy", 0),
                 table.number_or(row, "torque", 0)};
    disks.push_back(disk);
  }
  if (disks.empty()) throw InputError(fmt::format("{}: there is no disk in it", table.source()));
  return disks;
}

std::vector<Wall> read_walls(const Table& table, IdMap& ids) {
  table.require({"id", "px", "py", "nx", "ny"});
  table.allow_only({"id", "px", "py", "nx", "ny", "name", "load_n", "load_t"});
  std::vector<Wall> walls;
  for (int row = 0; row < table.rows(); ++row) {
    Wall wall;
    wall.id = unique_id(table, row, ids);
    wall.point = {table.number(row, "px"), table.number(row, "py")};
    wall.normal = {table.number(row, "nx"), table.number(row, "ny")};
    if (!table.is_empty(row, "name")) wall.name = table.text(row, "name");
    if (!table.is_empty(row, "load_n")) wall.load_n = table.number(row, "load_n");
    if (!table.is_empty(row, "load_t")) wall.load_t = table.number(row, "load_t");
    for (const auto& [name, load] : {std::pair("load_n", wall.load_n), {"load_t", wall.load_t}}) {
      if (!table.is_empty(row, name) && !std::isfinite(load))
        table.fail(row, name, "must be a finite number, or empty where the wall is fixed");
    }
    walls.push_back(wall);
  }
  return walls;
}

/// The bodies of a row of contacts.csv.
std::pair<DiskId, Body> read_bodies(const Table& table, int row, const IdMap& disks, const IdMap& walls) {
  const std::int32_t a = table.integer(row, "a");
  const std::int32_t b = table.integer(row, "b");
  if (a < 0 && b < 0) table.fail(row, "a wall cannot touch a wall");
  if (a < 0) table.fail(row, "a", fmt::format("{} is a wall; the wall of a contact must be b", a));
  const auto disk_a = disks.find(a);
  if (disk_a == disks.end()) table.fail(row, "a", fmt::format("there is no disk {}", a));
  const DiskId id_a(disk_a->second);
  if (b < 0) {
    const std::int32_t wall = -(b + 1);
    const auto wall_b = walls.find(wall);
    if (wall_b == walls.end())
      table.fail(row, "b", fmt::format("{} is wall {}, but there is no such wall", b, wall));
    return {id_a, Body::wall(WallId(wall_b->second))};
  }
  const auto disk_b = disks.find(b);
  if (disk_b == disks.end()) table.fail(row, "b", fmt::format("there is no disk {}", b));
  return {id_a, Body::disk(DiskId(disk_b->second))};
}

/// Where none is given, the nearest one.
Image read_image(const Table& table, int row, const Packing& packing, const Contact& contact) {
  if (table.is_empty(row, "image_x") != table.is_empty(row, "image_y"))
    table.fail(row, "image_x and image_y must both be given, or both be empty");
  const bool is_self = contact.b == Body::disk(contact.a);
  Image image{0, 0};
  if (!table.is_empty(row, "image_x")) {
    image = {table.integer(row, "image_x"), table.integer(row, "image_y")};
  } else if (!contact.b.is_wall() && !is_self) {
    image = nearest_image(packing, contact.a, contact.b.disk_id());
  }
  if (is_self && image == Image{0, 0})
    table.fail(row, fmt::format("disk {} cannot touch itself{}", packing[contact.a].id,
                                packing.cell.is_periodic() ? "; which image of it is not given" : ""));
  return image;
}

double read_friction(const Table& table, int row, const SceneFile& scene) {
  if (!table.is_empty(row, "mu")) return table.number(row, "mu");
  if (!scene.mu) {
    table.fail(row, fmt::format("the friction is not given, neither in column mu nor as mu = … in {}",
                                scene.source));
  }
  return *scene.mu;
}

/// The contacts that have equations, and the row of each.
struct ContactRows {
  std::vector<Contact> contacts;
  std::vector<int> rows;
};

ContactRows read_contacts(const Table& table, const Packing& packing, const IdMap& disks, const IdMap& walls,
                          const SceneFile& scene) {
  table.require({"a", "b"});
  table.allow_only({"a", "b", "nx", "ny", "mu", "R", "T", "gap", "lever_a", "lever_b", "R_lo", "R_hi", "T_lo",
                    "T_hi", "image_x", "image_y"});
  ContactRows result;
  std::map<ContactKey, int> rows;
  for (int row = 0; row < table.rows(); ++row) {
    Contact contact;
    std::tie(contact.a, contact.b) = read_bodies(table, row, disks, walls);
    contact.image = read_image(table, row, packing, contact);
    const auto [earlier, is_new] = rows.emplace(contact_key(contact), row);
    if (!is_new) {
      table.fail(row,
                 fmt::format("this contact is given twice, first in line {}", table.line(earlier->second)));
    }
    if (table.is_empty(row, "nx") != table.is_empty(row, "ny")) {
      table.fail(row, "nx and ny must both be given, or both be empty");
    }
    try {
      contact.normal = table.is_empty(row, "nx")
                           ? geometric_normal(packing, contact.a, contact.b, contact.image)
                           : Vector2(table.number(row, "nx"), table.number(row, "ny"));
    } catch (const InputError& error) {
      if (!table.is_empty(row, "nx")) throw;
      table.fail(row, error.what());
    }
    contact.gap = table.number_or(row, "gap", geometric_gap(packing, contact.a, contact.b, contact.image));
    contact.mu = read_friction(table, row, scene);
    contact.R = table.number_or(row, "R", kNaN);
    contact.T = table.number_or(row, "T", contact.mu == 0 && std::isfinite(contact.R) ? 0 : kNaN);
    contact.lever_a = table.number_or(row, "lever_a", kNaN);
    contact.lever_b = table.number_or(row, "lever_b", kNaN);
    contact.R_lo = table.number_or(row, "R_lo", -kInfinity);
    contact.R_hi = table.number_or(row, "R_hi", kInfinity);
    contact.T_lo = table.number_or(row, "T_lo", -kInfinity);
    contact.T_hi = table.number_or(row, "T_hi", kInfinity);
    if (!packing.has_equations(contact.a) && !packing.has_equations(contact.b)) continue;
    result.contacts.push_back(contact);
    result.rows.push_back(row);
  }
  return result;
}

/// Printed normals are rounded; within the tolerance that validation allows, the length is 1 by definition. A
/// normal of full precision keeps its bits.
void set_unit_length(Vector2& normal) {
  if (std::abs(normal.squaredNorm() - 1) > 4 * std::numeric_limits<double>::epsilon()) normal.normalize();
}

/// Throws the first defect of `packing` with the file and line that it comes from. `rows`: the row of each
/// part; empty where part i is row i.
void fail_at_defect(const Packing& packing, PackingPart part, const Table& table,
                    const std::vector<int>& rows = {}) {
  const auto defect = find_defect(packing);
  if (!defect || defect->part != part) return;
  table.fail(rows.empty() ? defect->index : rows[static_cast<std::size_t>(defect->index)], defect->reason);
}

/// Bounds that known forces break, that cost digits, or that mean 0.
void warn_of_bounds(ImportedPacking& imported) {
  const Packing& packing = imported.packing;
  const Eigen::VectorXd known = packing.simulated_forces().value();
  const double mg = packing.force_unit();
  int outside = 0;
  double worst = 0;
  const std::vector<ForceBound> bounds = force_bounds(packing);
  for (const ForceBound& bound : bounds) {
    const double beyond = -slack(bound, known);  // NaN where it is unknown
    outside += beyond > 0 ? 1 : 0;
    worst = std::fmax(worst, beyond);
  }
  const auto far = std::count_if(bounds.begin(), bounds.end(), [&](const ForceBound& bound) {
    return std::abs(bound.value) > tolerance::kFarBound * mg;
  });
  if (far > 0) {
    imported.warnings.push_back(
        fmt::format("{} beyond {:.0e} mg, which costs digits; leave the field empty where there is no limit",
                    counted(far, "bound of a force is", "bounds of forces are"), tolerance::kFarBound));
  }
  if (outside > 0) {
    imported.warnings.push_back(fmt::format("{} outside of {} bounds, the worst by {:.2e} mg",
                                            counted(outside, "known force is", "known forces are"),
                                            outside == 1 ? "its" : "their", worst / mg));
  }
  const auto pulls = std::count_if(packing.contacts.begin(), packing.contacts.end(),
                                   [](const Contact& c) { return c.R_lo < 0 && c.R_lo > -kInfinity; });
  if (pulls > 0) {
    imported.warnings.push_back(
        fmt::format("R_lo is negative at {}; contacts only push, so it means 0", counted(pulls, "contact")));
  }
}

}  // namespace

ImportedPacking read_csv_scene(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: is not a folder with disks.csv, contacts.csv, walls.csv, scene.toml",
                                 folder.string()));
  }
  ImportedPacking imported;
  Packing& packing = imported.packing;
  const SceneFile scene = read_scene_file(folder / "scene.toml");
  packing.gravity = scene.gravity;
  packing.named_force_unit = scene.force_unit;
  packing.cell = scene.cell;
  packing.stress = scene.stress;
  imported.stress_is_named = scene.names_stress;
  packing.origin.protocol = "import csv";

  const auto fail_in_scene = [&](PackingPart part, const char* name, int line) {
    const auto defect = find_defect(packing);
    if (defect && defect->part == part)
      throw InputError(fmt::format("{}:{}: {}: {}", scene.source, line, name, defect->reason));
  };
  // Each part is checked before the next one refers to it: a normal needs sound positions.
  IdMap disk_ids;
  const Table disks = read_csv(folder / "disks.csv");
  packing.disks = read_disks(disks, disk_ids);
  fail_in_scene(PackingPart::kCell, "cell", scene.cell_line);
  fail_in_scene(PackingPart::kStress, "stress", scene.stress_line);
  fail_at_defect(packing, PackingPart::kDisk, disks);
  IdMap wall_ids;
  if (fs::exists(folder / "walls.csv")) {
    const Table walls = read_csv(folder / "walls.csv");
    packing.walls = read_walls(walls, wall_ids);
    fail_at_defect(packing, PackingPart::kWall, walls);
  }
  const Table contacts = read_csv(folder / "contacts.csv");
  ContactRows kept = read_contacts(contacts, packing, disk_ids, wall_ids, scene);
  imported.without_equations = contacts.rows() - static_cast<int>(kept.rows.size());
  packing.contacts = std::move(kept.contacts);
  fail_at_defect(packing, PackingPart::kContact, contacts, kept.rows);
  validate(packing, scene.source);
  for (Wall& wall : packing.walls) set_unit_length(wall.normal);
  for (Contact& contact : packing.contacts) set_unit_length(contact.normal);
  try {
    for (std::string& note : take_out_cancelling_loads(packing)) imported.warnings.push_back(std::move(note));
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "{}: {}", (folder / (packing.cell.is_full() ? "disks.csv" : "walls.csv")).string(), error.what()));
  }
  warn_of_large_gaps(imported);
  warn_of_bounds(imported);
  return imported;
}

ImportFormat csv_format() {
  return {.name = "csv",
          .input = "the folder with disks.csv, contacts.csv, walls.csv, scene.toml",
          .options = {},
          .documented = {Lever::kRadius, Lever::kRadius},
          .lacks_friction = "",
          .files =
              [](const ImportRequest& request) {
                std::vector<fs::path> files;
                for (const char* name : kSceneFiles) files.push_back(request.input / name);
                return files;
              },
          .read = [](const ImportRequest& request) { return read_csv_scene(request.input); }};
}

}  // namespace indet
