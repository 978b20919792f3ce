#include "libindet/io/mercury_data_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/in_plane.h"
#include "libindet/io/packing_builder.h"

namespace indet {
namespace {

class DataReader {
 public:
  DataReader(const MercuryFiles& files, std::optional<double> time, const GivenWalls& given,
             const ImportSettings& settings)
      : frame_(read_mercury_frame(files, time)),
        particles_(frame_.particles),
        contacts_(frame_.contacts),
        given_(given),
        settings_(settings),
        plane_(settings.plane),
        builder_("import mercurydpm", "particle", particles_.source(), settings) {}

  ImportedPacking read() {
    for (std::string& warning : frame_.warnings) builder_.warn(std::move(warning));
    if (settings_.density.empty()) {
      throw InputError(
          fmt::format("{}: it has no masses; give the density of the particles with --density sphere=D (per "
                      "volume) or disk=D (per area)",
                      particles_.source()));
    }
    for (int row = 0; row < particles_.rows(); ++row) read_particle(row);
    builder_.close_disks();
    check_densities();
    for (int row = 0; row < contacts_.rows(); ++row) read_contact(row);
    close_pairs();
    check_given_walls();
    return builder_.build(std::nullopt);
  }

 private:
  /// A contact of two particles, and the row that said so first.
  struct Pair {
    Contact contact;
    int row = 0;
    int i = 0, j = 0;
    bool complete = false;  ///< Seen from both sides.
  };

  /// Three columns of a contact.
  Vector2 vector(int row, const std::array<const char*, 3>& columns) const {
    Eigen::Vector3d vector;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vector[static_cast<Eigen::Index>(axis)] = contacts_.number(row, columns[axis]);
    }
    return in_plane(vector, plane_, place_of(contacts_, row), fmt::format("({})", fmt::join(columns, ", ")));
  }

  static double finite(const Table& table, int row, const char* column) {
    const double value = table.number(row, column);
    if (!std::isfinite(value))
      table.fail(row, column, fmt::format("must be a finite number, but is {}", value));
    return value;
  }

  void read_particle(int row) {
    const Table& table = particles_;
    const bool spatial = table.has("z");
    const auto along = [&](const char* prefix, int axis) {
      return table.number(row, std::string(prefix) + Plane::letter(axis));
    };
    if (!spatial && plane_.normal != 2) {
      throw InputError(
          fmt::format("{}: the files are of two dimensions, x and y, so that --plane {} cannot be",
                      table.source(), plane_.name()));
    }
    Disk disk;
    disk.id = row;
    disk.position = {along("", plane_.first), along("", plane_.second)};
    disk.radius = table.number(row, "radius");
    disk.velocity = {along("v", plane_.first), along("v", plane_.second)};
    // Files of two dimensions count angles clockwise.
    disk.angular_velocity =
        spatial ? plane_.turned(along("omega_", plane_.normal)) : 0 - table.number(row, "omega");
    if (spatial) {
      const double height = along("", plane_.normal);
      if (row == 0) height_ = height;
      require_same_plane(height - height_, disk.radius, plane_, place_of(table, row),
                         fmt::format("particle {}", row));
    }
    const double info = table.number(row, "info");
    const bool is_species = info == std::floor(info) && info >= 0 && info <= std::numeric_limits<int>::max();
    const int species = is_species ? static_cast<int>(info) : -1;
    const auto inertia = settings_.density.of_particle(disk.radius, species);
    if (!inertia) {
      table.fail(row, fmt::format("the density of species {} is not known: give it with --density", info));
    }
    disk.mass = inertia->mass;
    disk.inertia = inertia->moment;
    builder_.add_disk(disk, species, place_of(table, row));
  }

  void check_densities() const {
    for (const auto& [type, unused] : settings_.density.types()) {
      bool found = false;
      for (int i = 0; i < builder_.packing().disk_count(); ++i) found |= builder_.type(DiskId(i)) == type;
      if (found) continue;
      throw InputError(
          fmt::format("{}: there is no particle of species {} to have a density", particles_.source(), type));
    }
  }

  DiskId particle(int row, int index) const {
    if (const auto found = builder_.find_disk(index)) return *found;
    place_of(contacts_, row)
        .fail(fmt::format(
            "there is no particle {}: {} has {} at time {} (images across a periodic boundary are "
            "not supported)",
            index, particles_.source(), particles_.rows(), frame_.time));
  }

  void read_contact(int row) {
    const int i = contacts_.integer(row, "i");
    const int j = contacts_.integer(row, "j");
    const DiskId a = particle(row, i);
    const Vector2 normal = vector(row, {"nx", "ny", "nz"});
    const double overlap = finite(contacts_, row, "overlap");
    const bool at_wall = j < 0;
    const Body b =
        at_wall ? Body::wall(wall(row, -(j + 1), a, normal, overlap)) : Body::disk(particle(row, j));
    Contact contact = builder_.contact(a, b, place_of(contacts_, row));
    // Of walls, MercuryDPM writes both vectors with the wrong sign.
    const double sign = at_wall ? -1 : 1;
    if ((sign * normal - contact.normal).norm() > tolerance::kSameWall) {
      contacts_.fail(
          row, fmt::format("the normal is ({:.6g}, {:.6g}), but ({:.6g}, {:.6g}) by the positions; do "
                           "both files belong together? (Contacts across a periodic boundary are not "
                           "supported.)",
                           normal.x(), normal.y(), sign * contact.normal.x(), sign * contact.normal.y()));
    }
    if (std::abs(contact.gap + overlap) > tolerance::kSameWall * builder_.packing()[a].radius) {
      contacts_.fail(row,
                     fmt::format("the overlap is {:.6g}, but {:.6g} by the positions; do both files belong "
                                 "together?",
                                 overlap, -contact.gap));
    }
    // The files round the overlap to ten digits of itself, the positions round it to ten of the radius.
    contact.gap = -overlap;
    contact.R = finite(contacts_, row, "normal_force");
    contact.T = sign * tangential_force(row, contact);
    if (at_wall) {
      builder_.add_contact(contact, place_of(contacts_, row));
    } else {
      add_side(row, i, j, contact);
    }
  }

  /// F_t times the component of t along t̂, which is 1 or −1.
  double tangential_force(int row, const Contact& contact) const {
    const double force = finite(contacts_, row, "tangential_force");
    const double along = vector(row, {"tx", "ty", "tz"}).dot(contact.tangent());
    if (force != 0 && std::abs(std::abs(along) - 1) > tolerance::kSameWall) {
      contacts_.fail(row, "(tx, ty, tz) must be a unit vector along the contact");
    }
    return force * along;
  }

  /// Takes one of the two rows of a pair.
  void add_side(int row, int i, int j, const Contact& contact) {
    const auto [found, is_new] = pairs_.emplace(std::minmax(i, j), Pair{contact, row, i, j});
    if (is_new) return;
    Pair& before = found->second;
    const int line = contacts_.line(before.row);
    if (before.complete || before.i == i) {
      contacts_.fail(
          row, fmt::format("particles {} and {} are listed {} from the side of {}, first in line {}", i, j,
                           before.complete ? "again" : "twice", i, line));
    }
    const Contact& other = before.contact;
    const double allowed = tolerance::kPrintedForce * std::hypot(other.R, other.T);
    if (std::hypot(contact.R - other.R, contact.T - other.T) > allowed) {
      contacts_.fail(
          row, fmt::format("the force of particles {} and {} is another one than in line {}", i, j, line));
    }
    before.complete = true;
  }

  /// Adds the pairs, which must be listed from each side that is not held fixed.
  void close_pairs() {
    std::vector<const Pair*> in_order;
    for (const auto& [key, pair] : pairs_) in_order.push_back(&pair);
    std::sort(in_order.begin(), in_order.end(), [](const Pair* a, const Pair* b) { return a->row < b->row; });
    for (const Pair* pair : in_order) {
      if (!pair->complete && !builder_.packing()[*builder_.find_disk(pair->j)].fixed) {
        contacts_.fail(
            pair->row,
            fmt::format("particles {0} and {1} are listed from the side of {0} alone; is the file "
                        "truncated, or is particle {1} fixed (--fixed {1})? MercuryDPM leaves out the "
                        "side of fixed particles",
                        pair->i, pair->j));
      }
      builder_.add_contact(pair->contact, place_of(contacts_, pair->row));
    }
  }

  /// Wall k, added when the first particle touches it. `outwards`: the normal of the row, into the wall.
  WallId wall(int row, int k, DiskId a, const Vector2& outwards, double overlap) {
    const Disk& disk = builder_.packing()[a];
    const double offset = outwards.dot(disk.position) + disk.radius - overlap;
    const std::string name = std::to_string(k);
    if (const auto found = walls_.find(k); found != walls_.end()) {
      const Wall& wall = builder_.packing()[found->second];
      if ((wall.normal + outwards).norm() > tolerance::kSameWall ||
          std::abs(wall.normal.dot(wall.point) + offset) > tolerance::kSameWall * disk.radius) {
        contacts_.fail(row,
                       fmt::format("wall {} is not the plane here that it is in line {}; curved and composed "
                                   "walls are not supported",
                                   name, wall_lines_.at(k)));
      }
      return found->second;
    }
    if (!(std::abs(outwards.norm() - 1) <= tolerance::kSameWall)) {
      contacts_.fail(row, "(nx, ny, nz) must be a unit vector");
    }
    const Vector2 unit = outwards.stableNormalized();
    Wall wall{.id = builder_.packing().wall_count(),
              .point = offset * unit,
              .normal = Vector2(0, 0) - unit,
              .name = name};
    if (const auto given = given_.find(name); given != given_.end()) put(given->second, row, wall);
    wall_lines_.emplace(k, contacts_.line(row));
    return walls_.emplace(k, builder_.add_wall(wall, {}, place_of(contacts_, row))).first->second;
  }

  /// Moves a wall onto the plane that is given for it, which must be nearly its own.
  void put(const GivenWall& given, int row, Wall& wall) const {
    Vector2 point(0, 0);
    Vector2 normal(0, 0);
    point[given.axis] = given.position;
    normal[given.axis] = wall.normal[given.axis] > 0 ? 1 : -1;
    const double distance = wall.normal.dot(point - wall.point);
    if ((normal - wall.normal).norm() > tolerance::kSameWall ||
        std::abs(distance) > tolerance::kSameWall * builder_.packing().max_radius()) {
      contacts_.fail(
          row, fmt::format("wall {} lies at ({:.6g}, {:.6g}) with normal ({:.6g}, {:.6g}) by this contact; "
                           "is its plane {}?",
                           wall.name, wall.point.x(), wall.point.y(), wall.normal.x(), wall.normal.y(),
                           given.text));
    }
    wall.point = point;
    wall.normal = normal;
  }

  void check_given_walls() const {
    std::set<std::string> touched;
    for (const auto& [k, unused] : walls_) touched.insert(std::to_string(k));
    for (const auto& [name, given] : given_) {
      if (touched.contains(name)) continue;
      throw InputError(
          fmt::format("{}: no particle touches wall {} ({}); {}", contacts_.source(), name, given.text,
                      touched.empty() ? "there are no walls at all"
                                      : fmt::format("the walls are {}", fmt::join(touched, ", "))));
    }
  }

  MercuryFrame frame_;
  const Table& particles_;
  const Table& contacts_;
  const GivenWalls& given_;
  const ImportSettings& settings_;
  Plane plane_;
  PackingBuilder builder_;
  double height_ = 0;  ///< Of all centres, along the normal of the plane.
  std::map<std::pair<int, int>, Pair> pairs_;
  std::map<int, WallId> walls_;
  std::map<int, int> wall_lines_;  ///< Of the first contact with each wall.
};

}  // namespace

ImportedPacking read_mercury_data(const MercuryFiles& files, std::optional<double> time,
                                  const GivenWalls& walls, const ImportSettings& settings) {
  return DataReader(files, time, walls, settings).read();
}

}  // namespace indet
