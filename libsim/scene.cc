#include "libsim/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"

namespace indet::sim {
namespace {

/// Cell of the grid in units of radius_max: 5 × 19 of them fill the box of 95 disks, 11 × 38.
constexpr double kCellWidth = 2.2;
constexpr double kCellHeight = 2.0;

int row_count(const Scene& scene) { return (scene.disks + scene.columns - 1) / std::max(1, scene.columns); }

Wall wall(const Vector2& point, const Vector2& normal, const char* name) {
  return Wall{.id = 0, .point = point, .normal = normal, .name = name};
}

std::vector<Wall> walls_of(const Scene& scene) {
  std::vector<Wall> walls;
  const double middle = scene.width / 2;
  switch (scene.container) {
    case Container::kBox:
      walls.push_back(wall({0, 0}, {0, 1}, "floor"));
      walls.push_back(wall({0, 0}, {1, 0}, "left"));
      walls.push_back(wall({scene.width, 0}, {-1, 0}, "right"));
      break;
    case Container::kFloor:
      walls.push_back(wall({0, 0}, {0, 1}, "floor"));
      break;
    case Container::kFunnel: {
      const double slope = scene.funnel_angle * std::numbers::pi / 180;
      walls.push_back(wall({middle, 0}, {std::sin(slope), std::cos(slope)}, "funnel left"));
      walls.push_back(wall({middle, 0}, {-std::sin(slope), std::cos(slope)}, "funnel right"));
      walls.push_back(wall({0, 0}, {1, 0}, "left"));
      walls.push_back(wall({scene.width, 0}, {-1, 0}, "right"));
      break;
    }
    case Container::kNone:
      break;
  }
  walls.insert(walls.end(), scene.walls.begin(), scene.walls.end());
  for (std::size_t i = 0; i < walls.size(); ++i) walls[i].id = static_cast<std::int32_t>(i);
  return walls;
}

/// Numbers whose products are in the range of a double.
constexpr double kLeast = 1e-60;
constexpr double kMost = 1e60;

/// The first dimensional number of the scene that is out of this range; 0 where `may_be_zero`.
std::optional<std::string> out_of_range(const Scene& scene) {
  struct Named {
    const char* name;
    double value;
    bool may_be_zero;
  };
  for (const auto& [name, value, may_be_zero] :
       {Named{"radius", scene.radius_min, false}, Named{"radius", scene.radius_max, false},
        Named{"density", scene.density, false}, Named{"gravity", scene.gravity.stableNorm(), true},
        Named{"force_unit", scene.force_unit, true}, Named{"width", scene.width, true},
        Named{"height", scene.height, true}, Named{"friction", scene.friction.disk, true},
        Named{"friction", scene.friction.wall, true}}) {
    if ((may_be_zero && value == 0) || (value >= kLeast && value <= kMost)) continue;
    return fmt::format("{} must be {}from {:g} to {:g}, but is {}", name, may_be_zero ? "0, or " : "", kLeast,
                       kMost, value);
  }
  return {};
}

/// Height at which the lowest row starts: a funnel must hold it.
double base_height(const Scene& scene) {
  if (scene.container != Container::kFunnel) return 0;
  return scene.width / 2 * std::tan(scene.funnel_angle * std::numbers::pi / 180);
}

}  // namespace

std::string to_string(Container container) {
  switch (container) {
    case Container::kBox:
      return "box";
    case Container::kFloor:
      return "floor";
    case Container::kFunnel:
      return "funnel";
    case Container::kNone:
      return "none";
  }
  return {};
}

Container container_from(const std::string& name) {
  for (const Container c : {Container::kBox, Container::kFloor, Container::kFunnel, Container::kNone}) {
    if (to_string(c) == name) return c;
  }
  throw InputError(
      fmt::format("there is no container \"{}\": it must be box, floor, funnel or none", excerpt(name)));
}

Scene Scene::resolved() const {
  Scene scene = *this;
  if (scene.columns == 0) {
    scene.columns = std::max(1, static_cast<int>(std::lround(5 * std::sqrt(std::max(1, disks) / 95.0))));
    if (scene.width > 0) {
      scene.columns = std::min(scene.columns, static_cast<int>(scene.width / (kCellHeight * radius_max)));
    }
    scene.columns = std::max(1, std::min(scene.columns, std::max(1, disks)));
  }
  if (scene.width == 0) scene.width = kCellWidth * radius_max * scene.columns;
  if (scene.height == 0) scene.height = kCellHeight * radius_max * row_count(scene);
  return scene;
}

std::optional<std::string> Scene::defect() const {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (disks < 1) return fmt::format("disks must be at least 1, but is {}", disks);
  if (!(radius_min > 0) || !(radius_max >= radius_min) || !finite(radius_max)) {
    return fmt::format("radii must satisfy 0 < radius_min ≤ radius_max, but are {} and {}", radius_min,
                       radius_max);
  }
  if (!(density > 0) || !finite(density)) return fmt::format("density must be positive, but is {}", density);
  if (!(friction.disk >= 0) || !(friction.wall >= 0) || !finite(friction.disk + friction.wall)) {
    return fmt::format("friction must not be negative, but is {} and {}", friction.disk, friction.wall);
  }
  if (!finite(gravity.sum())) return "gravity must be two finite numbers";
  if (!(force_unit >= 0) || !finite(force_unit)) return "force_unit must be positive";
  if (const auto reason = out_of_range(*this)) return reason;
  if (gravity.isZero(0) && force_unit == 0) return "a scene without gravity must name its force_unit";
  if (!(jitter >= 0 && jitter <= 1)) return fmt::format("jitter must be in [0, 1], but is {}", jitter);
  if (columns < 0) return fmt::format("columns must not be negative, but is {}", columns);
  if (!(funnel_angle > 0 && funnel_angle < 90)) {
    return fmt::format("funnel_angle must be between 0 and 90 degrees, but is {}", funnel_angle);
  }
  for (const Wall& w : walls) {
    if (!finite(w.point.sum()) || !(std::abs(w.normal.norm() - 1) < tolerance::kNormalLength)) {
      return fmt::format("wall \"{}\": its point must be finite, and its normal have length 1",
                         excerpt(w.name));
    }
  }
  const Scene full = resolved();
  const double cell_width = full.width / full.columns;
  const double cell_height = full.height / row_count(full);
  const double least = 2 * radius_max * (1 - tolerance::kCellSize);
  if (!(cell_width >= least) || !(cell_height >= least)) {
    return fmt::format(
        "the grid of {} × {} cells in {} × {} has cells of {:.4g} × {:.4g}, too small for disks of diameter "
        "{}: make the "
        "box larger or set columns",
        full.columns, row_count(full), full.width, full.height, cell_width, cell_height, 2 * radius_max);
  }
  return {};
}

namespace {

/// Throws InputError if a disk of the grid starts beyond a wall, which would throw it out.
void require_inside(const World& world, const Scene& full, double base) {
  for (int i = 0; i < world.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const Vector2 centre(world.x[row], world.y[row]);
    for (const Wall& wall : world.walls) {
      const double gap = (centre - wall.point).dot(wall.normal) - world.radius[row];
      // The sizes of a cell, and the coordinates that it is reckoned in, are rounded.
      const double rounding = tolerance::kWallStart * std::max(full.radius_max, full.width + full.height);
      if (gap >= -rounding) continue;
      throw InputError(fmt::format(
          "disk {} (centre ({:.6g}, {:.6g}), radius {:.6g}) starts {:.6g} inside wall {}: the grid of {} × "
          "{} cells fills 0 ≤ x ≤ {:.6g}, {:.6g} ≤ y ≤ {:.6g}; move the wall, or turn its normal ({}, {}), "
          "which points into the domain",
          i, centre.x(), centre.y(), world.radius[row], -gap,
          wall.name.empty() ? std::to_string(wall.id) : wall.name, full.columns, row_count(full), full.width,
          base, base + full.height, wall.normal.x(), wall.normal.y()));
    }
  }
}

}  // namespace

World build(const Scene& scene) {
  if (const auto reason = scene.defect()) throw InputError(*reason);
  const Scene full = scene.resolved();
  const int rows = row_count(full);
  const double cell_width = full.width / full.columns;
  const double cell_height = full.height / rows;
  const double base = base_height(full);

  World world;
  world.walls = walls_of(full);
  world.gravity = full.gravity;
  world.friction = full.friction;
  world.named_force_unit = full.force_unit;
  Random random(full.seed);
  for (int i = 0; i < full.disks; ++i) {
    const double radius = random.uniform(full.radius_min, full.radius_max);
    const double room_x = cell_width / 2 - radius;
    const double room_y = cell_height / 2 - radius;
    const double move_x = full.jitter * room_x * random.uniform(-1, 1);
    const double move_y = full.jitter * room_y * random.uniform(-1, 1);
    const double mass = full.density * std::numbers::pi * radius * radius;
    const int column = i % full.columns;
    const int row = i / full.columns;
    world.add(
        Disk{.id = i,
             .position = {(column + 0.5) * cell_width + move_x, base + (row + 0.5) * cell_height + move_y},
             .radius = radius,
             .mass = mass,
             .inertia = mass * radius * radius / 2});
  }
  require_inside(world, full, base);
  return world;
}

}  // namespace indet::sim
