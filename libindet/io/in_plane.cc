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
  return {vector[plane.first], vector[plane.second]};
}

}  // namespace indet
