#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libsim/world.h"

namespace indet::sim {

/// Where the disks are kept.
///   box     floor and two side walls at x = 0 and x = width, open at the top
///   floor   the half-plane y ≥ 0
///   funnel  a box whose floor is two half-planes that slope down to the middle by `funnel_angle`
///   none    no walls (with `walls`: only those)
enum class Container { kBox, kFloor, kFunnel, kNone };

/// A scene to be filled: disks on a grid of columns × rows cells, each moved at random within its cell, radii
/// uniform in [radius_min, radius_max]. Everything is in the scene's own units.
struct Scene {
  int disks = 95;
  double radius_min = 0.7;
  double radius_max = 1.0;
  double density = 1.0;  ///< Mass per area; the moment of inertia is m r²/2.
  Friction friction = {};
  Vector2 gravity{0, -1};
  double force_unit = 0;  ///< Needed without gravity; 0: the mean weight.

  Container container = Container::kBox;
  double width = 0;  ///< Lx; 0: 2.2 radius_max a column.
  double height =
      0;  ///< Ly; 0: 2 radius_max a row. Only the grid and the time limit know it: the top is open.
  double funnel_angle = 30;      ///< Slope of the funnel's sides, degrees.
  std::vector<Wall> walls = {};  ///< More walls, or all of them with `none`.

  int columns = 0;    ///< Of the grid; 0: such that width/height stays 11/38, the shape for 95 disks.
  double jitter = 1;  ///< Fraction of the room in its cell that a disk is moved in; 0: an aligned grid.
  std::uint64_t seed = 0;

  /// The reason why the scene cannot be built, if there is one.
  std::optional<std::string> defect() const;
  /// columns, width and height with their defaults filled in.
  Scene resolved() const;
};

/// Puts the disks on the grid, at rest. Row 0 is the lowest, so that neighbours in space are near in memory.
/// The grid fills 0 ≤ x ≤ Lx, y_0 ≤ y ≤ y_0 + Ly; y_0 = 0, in a funnel the height of its sides. Throws
/// InputError with the scene's defect, or if a disk starts inside a wall.
World build(const Scene& scene);

std::string to_string(Container container);
/// Throws InputError if there is no container of that name.
Container container_from(const std::string& name);

}  // namespace indet::sim
