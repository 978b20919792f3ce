#include "libindet/io/in_plane.h"

#include <fmt/format.h>

#include <cmath>

#include "libindet/base/tolerances.h"

namespace indet {

Vector2 in_plane(const Eigen::Vector3d& vector, const Plane& plane, const Place& place,
                 const std::string& what) {
  if (!vector.allFinite()) {
    place.fail(fmt::format("{} is not finite: ({}, {}, {})", what, vector.x(), vector.y(), vector.z()));
  }
  if (std::abs(vector[plane.normal]) > tolerance::kOutOfPlane * vector.norm()) {
    place.fail(
        fmt::format("{} points out of the plane {}; only packings in a plane can be read (--plane xy or xz)",
                    what, plane.name()));
  }
  return plane.components(vector);
}

void require_same_plane(double height, double radius, const Plane& plane, const Place& place,
                        const std::string& what) {
  if (std::abs(height) <= tolerance::kSameWall * std::abs(radius)) return;
  place.fail(
      fmt::format("{} lies {:.3g} off the plane {} of the first one; only packings in a plane can be read "
                  "(--plane xy or xz)",
                  what, height, plane.name()));
}

}  // namespace indet
