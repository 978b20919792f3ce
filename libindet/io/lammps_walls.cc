#include "libindet/io/lammps_walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libindet/base/tolerances.h"
#include "libindet/io/lammps_atoms.h"

namespace indet {
namespace {

/// A disk that touches the wall of a fix.
struct Touch {
  DiskId disk;
  int row;
  Vector2 point, normal, force;  ///< normal: from the contact point to the centre
  std::size_t side = 0;
};

/// A plane through contact points.
struct Side {
  Vector2 point, normal;
  int touches = 0;
};

bool same_direction(const Vector2& a, const Vector2& b) { return (a - b).norm() <= tolerance::kSameWall; }

bool along_an_axis(const Vector2& normal) {
  return std::min(std::abs(normal.x()), std::abs(normal.y())) <= tolerance::kSameWall;
}

/// Puts each touch on a side.
std::vector<Side> find_sides(std::vector<Touch>& touches, double radius) {
  std::vector<Side> sides;
  for (Touch& touch : touches) {
    const auto found = std::find_if(sides.begin(), sides.end(), [&](const Side& side) {
      return same_direction(side.normal, touch.normal) &&
             std::abs((touch.point - side.point).dot(side.normal)) <= tolerance::kSameWall * radius;
    });
    touch.side = static_cast<std::size_t>(found - sides.begin());
    if (found == sides.end()) sides.push_back({touch.point, touch.normal});
    ++sides[touch.side].touches;
  }
  return sides;
}

/// A side that is no plane which stands still, if there is one.
std::optional<std::size_t> find_odd_side(const std::vector<Side>& sides) {
  if (sides.size() <= 1) return {};
  if (sides.size() == 2 && same_direction(sides[0].normal, -sides[1].normal)) return {};
  // The side with the fewest touches is the odd one: points of a curve have a side each.
  std::optional<std::size_t> odd;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool moved = std::any_of(sides.begin(), sides.end(), [&](const Side& other) {
      return &other != &sides[i] && same_direction(other.normal, sides[i].normal);
    });
    if (!moved && (along_an_axis(sides[i].normal) || sides[i].touches >= 2)) continue;
    if (!odd || sides[i].touches < sides[*odd].touches) odd = i;
  }
  return odd;
}

}  // namespace

void read_lammps_walls(const DumpFrame& frame, const LammpsColumns& names, const Plane& plane,
                       const std::vector<int>& rows, PackingBuilder& builder) {
  const Table& table = frame.table;
  const Packing& packing = builder.packing();
  for (const auto& [name, prefix] : names.walls(table)) {
    const auto field = [&table, p = prefix](int row, int i) {
      return table.number(row, fmt::format("{}[{}]", p, i));
    };
    std::vector<Touch> touches;
    for (int index = 0; index < packing.disk_count(); ++index) {
      const int row = rows[static_cast<std::size_t>(index)];
      if (field(row, 1) == 0) continue;
      const Disk& disk = packing[DiskId(index)];
      Touch touch{.disk = DiskId(index),
                  .row = row,
                  .point = {field(row, 5 + plane.first), field(row, 5 + plane.second)},
                  .normal = {},
                  .force = {field(row, 2 + plane.first), field(row, 2 + plane.second)}};
      if (std::abs(field(row, 2 + plane.normal)) > tolerance::kOutOfPlane * touch.force.norm()) {
        table.fail(row,
                   fmt::format("wall {} pushes atom {} along {}; only packings in the plane {}, {} can be "
                               "read{}",
                               name, disk.id, Plane::letter(plane.normal), Plane::letter(plane.first),
                               Plane::letter(plane.second), plane.second == 1 ? " (or --plane xz)" : ""));
      }
      touch.normal = (disk.position - touch.point).stableNormalized();
      if (!(touch.normal.squaredNorm() > 0.5)) {
        table.fail(row, fmt::format("the contact point of wall {} is the centre of the atom", name));
      }
      touches.push_back(touch);
    }
    const std::vector<Side> sides = find_sides(touches, packing.max_radius());
    if (const auto odd = find_odd_side(sides)) {
      const auto touch =
          std::find_if(touches.begin(), touches.end(), [&](const Touch& t) { return t.side == *odd; });
      table.fail(
          touch->row,
          fmt::format("wall {} is not made of planes that stand still: its contact point ({}, {}) is off "
                      "the planes of the others",
                      name, touch->point.x(), touch->point.y()));
    }
    std::vector<WallId> walls;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const auto touch =
          std::find_if(touches.begin(), touches.end(), [&](const Touch& t) { return t.side == i; });
      walls.push_back(builder.add_wall(Wall{.id = packing.wall_count(),
                                            .point = sides[i].point,
                                            .normal = sides[i].normal,
                                            .name = i == 0 ? name : fmt::format("{} ({})", name, i + 1)},
                                       {name}, place_of(table, touch->row)));
    }
    for (const Touch& touch : touches) {
      const Place place = place_of(table, touch.row);
      Contact contact = builder.contact(touch.disk, Body::wall(walls[touch.side]), place);
      contact.normal = touch.normal;
      PackingBuilder::project(contact, touch.force);
      builder.add_contact(contact, place);
    }
  }
  if (packing.wall_count() == 0 && !packing.cell.is_full()) {
    builder.warn(fmt::format(
        "{}: no wall was read, so that forces of walls are missing if there are any; give each fix wall/gran "
        "the keyword contacts, and dump its columns f_NAME[*]",
        table.source()));
  }
}

}  // namespace indet
