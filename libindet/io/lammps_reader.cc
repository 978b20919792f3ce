#include "libindet/io/lammps_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/lammps_dump.h"
#include "libindet/packing/validate.h"

namespace indet {
namespace {

constexpr const char* kFormatHint = "write it with: dump_modify ID format float %.17g";

/// Names of columns: the defaults of the documented script, and what the user put in their place.
class ColumnNames {
 public:
  explicit ColumnNames(const std::map<std::string, std::string>& mapped) {
    for (const auto& [key, name] : mapped) {
      if (key.starts_with("wall:") && key.size() > 5) {
        walls_[key.substr(5)] = name;
      } else if (const auto known = names_.find(key); known != names_.end()) {
        known->second = name;
      } else {
        std::string keys;
        for (const auto& [valid, unused] : names_) keys += valid + ", ";
        throw InputError(fmt::format("--columns: {} is unknown; the known ones are {}wall:NAME", key, keys));
      }
    }
  }

  const std::string& operator[](const std::string& key) const { return names_.at(key); }

  /// Name and column prefix of each wall: those that the user named, else every fix of which the dump has the
  /// eighth column (the number of columns of a wall fix).
  std::map<std::string, std::string> walls(const Table& atoms) const {
    std::map<std::string, std::string> found = walls_;
    if (found.empty()) {
      for (const std::string& column : atoms.columns()) {
        if (column.starts_with("f_") && column.ends_with("[8]") &&
            !atoms.has(column.substr(0, column.size() - 2) + "9]")) {
          const std::string prefix = column.substr(0, column.size() - 3);
          found[prefix.substr(2)] = prefix;
        }
      }
    }
    for (const auto& [name, prefix] : found) {
      for (int i = 1; i <= 8; ++i) atoms.require({fmt::format("{}[{}]", prefix, i)});
    }
    return found;
  }

 private:
  std::map<std::string, std::string> names_ = {
      {"id", "id"},      {"x", "x"},        {"y", "y"},           {"radius", "radius"}, {"mass", "mass"},
      {"vx", "vx"},      {"vy", "vy"},      {"omegaz", "omegaz"}, {"atom1", "c_pp[1]"}, {"atom2", "c_pp[2]"},
      {"fx", "c_pl[3]"}, {"fy", "c_pl[4]"}, {"p1", "c_pl[5]"},    {"p2", "c_pl[6]"}};
  std::map<std::string, std::string> walls_;
};

/// Number of significant digits of a printed number.
int significant_digits(std::string_view text) {
  int digits = 0;
  for (const char c : text.substr(0, text.find_first_of("eE"))) {
    if (c >= '0' && c <= '9' && (digits > 0 || c != '0')) ++digits;
  }
  return digits;
}

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
    warn_of_rounding();
    warn_of_atoms_outside();
    warn_of_contacts_without_force();
    warn_of_large_gaps(imported_);
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
      ++apart_;
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
      discarded_ = std::max({discarded_, std::abs(normal_force.dot(contact.tangent())),
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
    const double allowed = 1e-5 * std::hypot(first.R, first.T);  // six printed digits
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
        if (std::abs(field(row, 4)) > tolerance::kSliding * force.norm()) {
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
      if ((wall.normal - normal).norm() > tolerance::kNormalDirection) continue;
      const double offset = std::abs((point - wall.point).dot(wall.normal));
      if (offset <= tolerance::kNormalDirection * packing_.max_radius()) return WallId(i);
    }
    const int count = packing_.wall_count() - first_wall;
    if (count > 1 ||
        (count == 1 && (packing_.walls.back().normal + normal).norm() > tolerance::kNormalDirection)) {
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

  void warn(std::string text) { imported_.warnings.push_back(std::move(text)); }

  void warn_of_rounding() {
    int digits = 0;
    for (int row = 0; row < atoms_.table.rows(); ++row) {
      digits = std::max({digits, significant_digits(atoms_.table.text(row, names_["x"])),
                         significant_digits(atoms_.table.text(row, names_["y"]))});
    }
    // Fewer than four digits are no format but a scene made by hand.
    if (digits >= 4 && digits <= 12) {
      imported_.rounding = 0.5 * std::pow(10.0, 1 - digits);
      warn(fmt::format("{}: numbers have only {} digits, which limits the balance of forces; {}",
                       options_.atoms.string(), digits, kFormatHint));
    }
    const double unit = packing_.force_unit();
    double largest = unit;
    for (const Contact& contact : packing_.contacts) largest = std::max(largest, std::abs(contact.R));
    if (discarded_ > std::max(1e-6 * unit, 1e3 * imported_.rounding * largest)) {
      warn(
          fmt::format("{}: the normal force ({}, {}) has tangential parts or the tangential force ({}, {}) "
                      "normal ones, up to {:.3g} mg, which are ignored; are the columns the right ones?",
                      options_.contacts.string(), names_["fx"], names_["fy"], names_["p1"], names_["p2"],
                      discarded_ / unit));
    }
  }

  void warn_of_atoms_outside() {
    std::set<int> outside;
    for (int i = 0; i < packing_.disk_count(); ++i) {
      const Vector2& position = packing_[DiskId(i)].position;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double x = position[static_cast<Eigen::Index>(axis)];
        if (atoms_.low[axis] < atoms_.high[axis] && (x < atoms_.low[axis] || x > atoms_.high[axis])) {
          outside.insert(i);
        }
      }
      for (const Wall& wall : packing_.walls) {
        if ((position - wall.point).dot(wall.normal) < 0) outside.insert(i);
      }
    }
    if (outside.empty()) return;
    warn(fmt::format("{}: {} outside the box or behind a wall; the first is atom {}", options_.atoms.string(),
                     counted(static_cast<std::int64_t>(outside.size()), "atom is", "atoms are"),
                     packing_[DiskId(*outside.begin())].id));
  }

  void warn_of_contacts_without_force() {
    if (imported_.duplicates > 0) {
      warn(fmt::format("{}: {} given twice with the same force, and taken once", options_.contacts.string(),
                       counted(imported_.duplicates, "contact is", "contacts are")));
    }
    if (apart_ > 0) {
      warn(fmt::format(
          "{}: left out {}, which neither touch nor transmit a force (\"cutoff radius\" in the computes of "
          "LAMMPS would do the same)",
          options_.contacts.string(), counted(apart_, "pair of atoms", "pairs of atoms")));
    }
    const auto idle = std::count_if(packing_.contacts.begin(), packing_.contacts.end(),
                                    [](const Contact& c) { return c.R == 0 && c.T == 0; });
    if (idle > 0)
      warn(fmt::format("{}: kept {}, which transmit no force", options_.contacts.string(),
                       counted(idle, "contact whose atoms touch", "contacts whose atoms touch")));
  }

  const LammpsOptions& options_;
  ColumnNames names_;
  DumpFrame atoms_;
  DumpFrame pairs_;
  ImportedPacking imported_;
  Packing& packing_ = imported_.packing;
  std::unordered_map<std::int32_t, int> disk_of_id_;
  std::vector<int> disk_rows_;  ///< Row of each disk in the atoms.
  std::vector<FoundContact> contacts_;
  double discarded_ = 0;  ///< Largest part of a force that the projections drop.
  int apart_ = 0;
};

}  // namespace

ImportedPacking read_lammps(const LammpsOptions& options) { return Reader(options).read(); }

}  // namespace indet
