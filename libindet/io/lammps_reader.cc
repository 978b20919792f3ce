#include "libindet/io/lammps_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/lammps_columns.h"
#include "libindet/io/lammps_dump.h"
#include "libindet/io/lammps_warnings.h"
#include "libindet/packing/validate.h"

namespace indet {
namespace {

/// The contact of a row, before it is put into order.
struct FoundContact {
  Contact contact;
  const Table* table;
  int row;
};

class Reader {
 public:
  explicit Reader(const LammpsOptions& options)
      : options_(options),
        names_(options.columns),
        atoms_(read_dump_frame(options.atoms, options.timestep)),
        pairs_(read_dump_frame(options.contacts, options.timestep)) {
    if (!(options.friction >= 0) || !std::isfinite(options.friction)) {
      throw InputError(
          fmt::format("the friction coefficient must be a number ≥ 0, but is {}", options.friction));
    }
    if (atoms_.timestep != pairs_.timestep) {
      throw InputError(fmt::format(
          "{} ends with timestep {}, {} with {}; choose a timestep that both have with --timestep",
          options.atoms.string(), atoms_.timestep, options.contacts.string(), pairs_.timestep));
    }
  }

  ImportedPacking read() {
    packing_.gravity = options_.gravity;
    packing_.origin.protocol = "import lammps";
    read_disks();
    read_pairs();
    read_walls();
    sort_contacts();
    find_defects();
    warn_of_oddities(imported_, options_, names_, atoms_, remainder_);
    return std::move(imported_);
  }

 private:
  void read_disks() {
    const Table& table = atoms_.table;
    table.require({names_["id"], names_["x"], names_["y"], names_["radius"], names_["mass"]});
    std::vector<std::pair<std::int32_t, int>> order;
    for (int row = 0; row < table.rows(); ++row) order.emplace_back(table.integer(row, names_["id"]), row);
    std::sort(order.begin(), order.end());
    for (const auto& [id, row] : order) {
      const int index = packing_.disk_count();
      if (!disk_of_id_.emplace(id, index).second) table.fail(row, fmt::format("atom {} is given twice", id));
      Disk disk;
      disk.id = id;
      disk.position = {table.number(row, names_["x"]), table.number(row, names_["y"])};
      disk.radius = table.number(row, names_["radius"]);
      disk.mass = table.number(row, names_["mass"]);
      disk.inertia = 0.5 * disk.mass * disk.radius * disk.radius;
      disk.velocity = {table.number_or(row, names_["vx"], 0), table.number_or(row, names_["vy"], 0)};
      disk.angular_velocity = table.number_or(row, names_["omegaz"], 0);
      packing_.disks.push_back(disk);
      disk_rows_.push_back(row);
    }
    if (packing_.disks.empty()) throw InputError(fmt::format("{}: there is no atom in it", table.source()));
    const auto defect = find_defect(packing_);
    if (!defect) return;
    if (defect->part != PackingPart::kDisk) throw InputError(defect->reason);
    table.fail(disk_rows_[static_cast<std::size_t>(defect->index)], defect->reason);
  }

  DiskId disk(const Table& table, int row, const std::string& column) const {
    const std::int32_t id = table.integer(row, column);
    const auto found = disk_of_id_.find(id);
    if (found == disk_of_id_.end()) {
      table.fail(row, column, fmt::format("atom {} is not in {}", id, atoms_.table.source()));
    }
    return DiskId(found->second);
  }

  Contact new_contact(DiskId a, Body b) const {
    Contact contact;
    contact.a = a;
    contact.b = b;
    contact.mu = options_.friction;
    return contact;
  }

  /// Keeps a contact unless its bodies neither touch nor push each other.
  void keep(const Contact& contact, const Table& table, int row) {
    if (contact.gap > 0 && contact.R == 0 && contact.T == 0) {
      ++remainder_.apart;
    } else {
      contacts_.push_back({contact, &table, row});
    }
  }

  void read_pairs() {
    const Table& table = pairs_.table;
    table.require({names_["atom1"], names_["atom2"], names_["fx"], names_["fy"], names_["p1"], names_["p2"]});
    std::map<std::pair<std::int32_t, std::int32_t>, std::pair<int, Contact>> seen;
    for (int row = 0; row < table.rows(); ++row) {
      const DiskId a = disk(table, row, names_["atom1"]);
      const DiskId b = disk(table, row, names_["atom2"]);
      if (a == b) table.fail(row, fmt::format("atom {} cannot touch itself", packing_[a].id));
      Contact contact = new_contact(a, Body::disk(b));
      try {
        contact.normal = geometric_normal(packing_, a, contact.b);
      } catch (const InputError& error) {
        table.fail(row, error.what());
      }
      contact.gap = geometric_gap(packing_, a, contact.b);
      const Vector2 normal_force{table.number(row, names_["fx"]), table.number(row, names_["fy"])};
      const Vector2 tangential_force{table.number(row, names_["p1"]), table.number(row, names_["p2"])};
      contact.R = normal_force.dot(contact.normal);
      contact.T = tangential_force.dot(contact.tangent());
      remainder_.discarded = std::max({remainder_.discarded, std::abs(normal_force.dot(contact.tangent())),
                                       std::abs(tangential_force.dot(contact.normal))});
      const double reach = packing_[a].radius + packing_[b].radius;
      if (contact.gap > 0.1 * reach && (contact.R != 0 || contact.T != 0)) {
        table.fail(row,
                   fmt::format("atoms {} and {} push each other, but their surfaces are {:.3g} apart; {}",
                               packing_[a].id, packing_[b].id, contact.gap,
                               atoms_.periodic[0] || atoms_.periodic[1]
                                   ? "contacts across a periodic boundary are not supported"
                                   : "do both dumps belong together?"));
      }
      const std::pair<std::int32_t, std::int32_t> key = std::minmax({a.value(), b.value()});
      const auto [earlier, is_new] = seen.emplace(key, std::pair(row, contact));
      if (is_new) {
        keep(contact, table, row);
      } else if (same_force(earlier->second.second, contact)) {
        ++imported_.duplicates;
      } else {
        table.fail(row, fmt::format("the contact of atoms {} and {} is given twice, first in line {}, with "
                                    "another force",
                                    packing_[a].id, packing_[b].id, table.line(earlier->second.first)));
      }
    }
  }

  static bool same_force(const Contact& first, const Contact& second) {
    const double allowed = tolerance::kPrintedForce * std::hypot(first.R, first.T);
    return std::hypot(first.R - second.R, first.T - second.T) <= allowed;
  }

  void read_walls() {
    const Table& table = atoms_.table;
    for (const auto& [name, prefix] : names_.walls(table)) {
      const int first_wall = packing_.wall_count();
      const auto field = [&table, p = prefix](int row, int i) {
        return table.number(row, fmt::format("{}[{}]", p, i));
      };
      for (int index = 0; index < packing_.disk_count(); ++index) {
        const int row = disk_rows_[static_cast<std::size_t>(index)];
        if (field(row, 1) == 0) continue;
        const Vector2 force{field(row, 2), field(row, 3)};
        if (std::abs(field(row, 4)) > tolerance::kOutOfPlane * force.norm()) {
          table.fail(row,
                     fmt::format("wall {} pushes atom {} along z; only packings in the plane x, y can be "
                                 "read",
                                 name, packing_.disks[static_cast<std::size_t>(index)].id));
        }
        const DiskId a(index);
        const Vector2 point{field(row, 5), field(row, 6)};
        const Vector2 normal = (packing_[a].position - point).stableNormalized();
        if (!(normal.squaredNorm() > 0.5)) {
          table.fail(row, fmt::format("the contact point of wall {} is the centre of the atom", name));
        }
        Contact contact = new_contact(a, Body::wall(wall_of(name, first_wall, point, normal, row)));
        contact.normal = normal;
        contact.gap = geometric_gap(packing_, a, contact.b);
        contact.R = force.dot(normal);
        contact.T = force.dot(contact.tangent());
        keep(contact, table, row);
      }
    }
  }

  /// The wall of a fix that has this normal. A fix may have two opposite ones (`xplane 0 12`).
  WallId wall_of(const std::string& name, int first_wall, const Vector2& point, const Vector2& normal,
                 int row) {
    for (int i = first_wall; i < packing_.wall_count(); ++i) {
      const Wall& wall = packing_[WallId(i)];
      if ((wall.normal - normal).norm() > tolerance::kSameWall) continue;
      const double offset = std::abs((point - wall.point).dot(wall.normal));
      if (offset <= tolerance::kSameWall * packing_.max_radius()) return WallId(i);
    }
    const int count = packing_.wall_count() - first_wall;
    if (count > 1 || (count == 1 && (packing_.walls.back().normal + normal).norm() > tolerance::kSameWall)) {
      atoms_.table.fail(row,
                        fmt::format("wall {} is not a plane that stands still: its contact point ({}, {}) "
                                    "is off the plane of the others",
                                    name, point.x(), point.y()));
    }
    packing_.walls.push_back(Wall{.id = packing_.wall_count(),
                                  .point = point,
                                  .normal = normal,
                                  .name = count == 0 ? name : name + " (2)"});
    return WallId(packing_.wall_count() - 1);
  }

  void sort_contacts() {
    // Contacts of two disks first, then wall by wall.
    const auto key = [](const FoundContact& found) {
      const Contact& c = found.contact;
      return c.b.is_wall() ? std::tuple(1, c.b.wall_id().value(), c.a.value())
                           : std::tuple(0, c.a.value(), c.b.code());
    };
    std::sort(contacts_.begin(), contacts_.end(),
              [&](const FoundContact& left, const FoundContact& right) { return key(left) < key(right); });
    for (const FoundContact& found : contacts_) packing_.contacts.push_back(found.contact);
  }

  void find_defects() const {
    const auto defect = find_defect(packing_);
    if (!defect) return;
    if (defect->part == PackingPart::kContact) {
      const FoundContact& found = contacts_[static_cast<std::size_t>(defect->index)];
      found.table->fail(found.row, defect->reason);
    }
    throw InputError(fmt::format("{}: {}", options_.atoms.string(), defect->reason));
  }

  const LammpsOptions& options_;
  LammpsColumns names_;
  DumpFrame atoms_;
  DumpFrame pairs_;
  ImportedPacking imported_;
  Packing& packing_ = imported_.packing;
  std::unordered_map<std::int32_t, int> disk_of_id_;
  std::vector<int> disk_rows_;  ///< Row of each disk in the atoms.
  std::vector<FoundContact> contacts_;
  LammpsRemainder remainder_;
};

}  // namespace

ImportedPacking read_lammps(const LammpsOptions& options) { return Reader(options).read(); }

}  // namespace indet
