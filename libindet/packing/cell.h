#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "libindet/packing/vectors.h"

namespace indet {

/// Which image of body b a contact is with: that which lies at x_b + i a + j b, image = (i, j).
using Image = std::array<std::int32_t, 2>;

/// The cell of a periodic scene: what is at x is also at x + i a + j b for all whole numbers i, j. A scene
/// may be periodic in one direction, with walls along it; then one of the vectors is missing.
struct Cell {
  std::optional<Vector2> a, b;

  bool is_periodic() const { return a || b; }
  bool is_full() const { return a && b; }  ///< In both directions.
  /// |a × b|, to a rounding or two. Precondition: is_full().
  double area() const;
};

/// The stress that is imposed on a full cell of area A,
///
///     Σ_α f_i l_j = A σ_ij,   f = R n̂ + T t̂ the force on a,   l = x_a − (x_b + image · cell vectors),
///
/// in force per length; compression is positive. NaN: this component is not imposed. σ_yx is not: with lever
/// arms l_a + l_b = |l| it is σ_xy, by the torques. Instead of xx and yy the pressure (σ_xx + σ_yy)/2 may be.
struct Stress {
  double xx = std::numeric_limits<double>::quiet_NaN();
  double yy = std::numeric_limits<double>::quiet_NaN();
  double xy = std::numeric_limits<double>::quiet_NaN();
  double pressure = std::numeric_limits<double>::quiet_NaN();

  /// In the order of the components of Body::cell().
  std::array<double, 4> components() const { return {xx, yy, xy, pressure}; }
  int imposed_count() const;
  bool is_imposed() const { return imposed_count() > 0; }
  /// The component of that name; null if there is none.
  double* find(std::string_view name);
  /// Why these components cannot be imposed together; null if they can.
  const char* contradiction() const;
  double largest() const;  ///< magnitude of those that are imposed; 0 if none is

  static constexpr std::array<const char*, 4> kNames = {"xx", "yy", "xy", "pressure"};
};

/// What the component k of the stress (of Stress::components) takes of a contact: f_i l_j, or f·l/2.
inline double stress_part(int k, const Vector2& force, const Vector2& branch) {
  if (k == 3) return force.dot(branch) / 2;
  return force[k == 1 ? 1 : 0] * branch[k == 0 ? 0 : 1];
}

/// The motion of a cell by its multipliers y of the components: the rate of compression e, with Σ_k y_k
/// stress_part(k, f, l) = Σ f_i l_j e_ij. What lies at x moves with −e x beside its own velocity.
Eigen::Matrix2d compression(const std::array<double, 4>& multipliers);

}  // namespace indet
