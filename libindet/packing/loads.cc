#include "libindet/packing/loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Turned by multiples of 90°, exactly.
Vector2 quarter_turned(const Vector2& gravity, int quarters) {
  switch (((quarters % 4) + 4) % 4) {
    case 1:
      return {-gravity.y(), gravity.x()};
    case 2:
      return -gravity;
    case 3:
      return {gravity.y(), -gravity.x()};
    default:
      return gravity;
  }
}

}  // namespace

Vector2 turned(const Vector2& gravity, double angle) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  const double quarters = std::round(angle / kRightAngle);
  const double rest = angle - quarters * kRightAngle;
  const Vector2 g = quarter_turned(gravity, static_cast<int>(quarters));
  return std::cos(rest) * g + std::sin(rest) * quarter_turned(g, 1);
}

Vector3 Loads::wrench(const Packing& packing, DiskId disk) const {
  const Disk& body = packing[disk];
  if (body.fixed) return Vector3::Zero();
  Vector3 wrench = disks.empty() ? Vector3(0, 0, 0) : disks[static_cast<std::size_t>(disk.value())];
  wrench.head<2>() += body.mass * gravity;
  return wrench;
}

bool Loads::is_zero() const {
  const auto is_nothing = [](const auto& load) { return load.isZero(0); };
  return gravity.isZero(0) && std::all_of(disks.begin(), disks.end(), is_nothing) &&
         std::all_of(walls.begin(), walls.end(), is_nothing) &&
         std::all_of(stress.begin(), stress.end(), [](double s) { return s == 0; });
}

Loads combined(double weight, const Loads& loads, double other_weight, const Loads& others) {
  Loads sum;
  sum.gravity = weight * loads.gravity + other_weight * others.gravity;
  const auto add = [](const auto& from, double factor, auto& to) {
    to.resize(std::max(to.size(), from.size()), std::decay_t<decltype(to.front())>::Zero());
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += factor * from[i];
  };
  add(loads.disks, weight, sum.disks);
  add(others.disks, other_weight, sum.disks);
  add(loads.walls, weight, sum.walls);
  add(others.walls, other_weight, sum.walls);
  for (std::size_t k = 0; k < sum.stress.size(); ++k)
    sum.stress[k] = weight * loads.stress[k] + other_weight * others.stress[k];
  return sum;
}

Loads loads_of(const Packing& packing) {
  const auto known = [](double load) { return std::isnan(load) ? 0 : load; };
  Loads loads;
  loads.gravity = packing.gravity;
  for (const Disk& disk : packing.disks) loads.disks.push_back(disk.load);
  for (const Wall& wall : packing.walls) loads.walls.emplace_back(known(wall.load_n), known(wall.load_t));
  const auto stress = packing.stress.components();
  std::transform(stress.begin(), stress.end(), loads.stress.begin(), known);
  return loads;
}

std::string defect_of(const Loads& change, const Packing& packing) {
  const bool acts_on_mass = std::any_of(packing.disks.begin(), packing.disks.end(),
                                        [](const Disk& disk) { return !disk.fixed && disk.mass > 0; });
  if (!change.gravity.isZero(0) && !acts_on_mass)
    return "gravity reaches no contact: no disk that has mass is free";
  for (std::size_t i = 0; i < change.disks.size(); ++i) {
    if (packing.disks[i].fixed && !change.disks[i].isZero(0))
      return fmt::format("disk {} is fixed: a force on it does not reach any contact", packing.disks[i].id);
  }
  for (std::size_t w = 0; w < change.walls.size(); ++w) {
    const Wall& wall = packing.walls[w];
    for (const int k : {0, 1}) {
      const double load = k == 0 ? wall.load_n : wall.load_t;
      if (change.walls[w][k] == 0 || !std::isnan(load)) continue;
      return fmt::format("wall {} is fixed along its {}: a force on it does not reach any contact",
                         wall_name(wall), k == 0 ? "normal" : "tangent");
    }
  }
  const auto stress = packing.stress.components();
  for (std::size_t k = 0; k < stress.size(); ++k) {
    if (change.stress[k] != 0 && std::isnan(stress[k]))
      return fmt::format("the stress {} is not imposed on the packing", Stress::kNames[k]);
  }
  return "";
}

bool are_parallel(const Loads& loads, const Loads& others) {
  const auto numbers = [](const Loads& of) {
    std::vector<double> all(of.stress.begin(), of.stress.end());
    all.insert(all.end(), {of.gravity.x(), of.gravity.y()});
    for (const Vector3& load : of.disks) all.insert(all.end(), {load.x(), load.y(), load.z()});
    for (const Vector2& load : of.walls) all.insert(all.end(), {load.x(), load.y()});
    return all;
  };
  const std::vector<double> a = numbers(loads);
  const std::vector<double> b = numbers(others);
  const Eigen::Map<const Eigen::VectorXd> x(a.data(), std::ssize(a));
  const Eigen::Map<const Eigen::VectorXd> y(b.data(), std::ssize(b));
  const Eigen::VectorXd across = y.stableNormalized() - x.stableNormalized();
  const Eigen::VectorXd along = y.stableNormalized() + x.stableNormalized();
  return std::min(across.norm(), along.norm()) <= tolerance::kParallelLoads;
}

Packing under_alone(const Loads& loads, Packing packing) {
  packing.named_force_unit = packing.force_unit();
  packing.gravity.setZero();
  for (Disk& disk : packing.disks) disk.load.setZero();
  const auto to_nothing = [](double& load) { load = std::isnan(load) ? load : 0; };
  for (Wall& wall : packing.walls) {
    to_nothing(wall.load_n);
    to_nothing(wall.load_t);
  }
  for (const char* name : Stress::kNames) to_nothing(*packing.stress.find(name));
  return under(loads, 1, std::move(packing));
}

Packing under(const Loads& change, double lambda, Packing packing) {
  packing.gravity += lambda * change.gravity;
  for (std::size_t i = 0; i < change.disks.size(); ++i) packing.disks[i].load += lambda * change.disks[i];
  for (std::size_t w = 0; w < change.walls.size(); ++w) {
    packing.walls[w].load_n += lambda * change.walls[w][0];  // NaN stays NaN: it is not free
    packing.walls[w].load_t += lambda * change.walls[w][1];
  }
  for (std::size_t k = 0; k < change.stress.size(); ++k) {
    double* component = packing.stress.find(Stress::kNames[k]);
    *component += lambda * change.stress[k];
  }
  return packing;
}

}  // namespace indet
