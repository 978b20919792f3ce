#pragma once

#include <Eigen/Core>
#include <string>

namespace indet {

/// The plane in which the disks of a three-dimensional code lie, spanned by two of its axes. Its first axis
/// is x of the packing, its second one y; an angular velocity about e_x × e_y of the packing is `turn` times
/// the component along the axis that is left.
struct Plane {
  int first = 0, second = 1, normal = 2;
  int turn = 1;

  static Plane xy() { return {}; }
  /// x × z = −y.
  static Plane xz() { return {0, 2, 1, -1}; }

  static char letter(int axis) { return static_cast<char>('x' + axis); }
  /// The angular velocity of the packing, from that along the axis that is left. (−0 would be another
  /// number.)
  double turned(double omega) const { return turn > 0 ? omega : 0 - omega; }
  /// The components of a vector along both axes.
  Eigen::Vector2d components(const Eigen::Vector3d& vector) const { return {vector[first], vector[second]}; }
  std::string name() const { return {letter(first), letter(second)}; }
};

}  // namespace indet
