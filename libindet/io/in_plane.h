#pragma once

#include <Eigen/Core>
#include <string>

#include "libindet/io/packing_builder.h"
#include "libindet/io/plane.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The components of a vector in the plane. The one along the plane's normal must be nothing but rounding
/// (tolerance::kOutOfPlane of the length). Throws InputError, naming the place and `what` the vector is, if
/// it is more, or a component is not finite.
Vector2 in_plane(const Eigen::Vector3d& vector, const Plane& plane, const Place& place,
                 const std::string& what);

/// The disk called `what` lies in the plane of the first one. `height`: along the plane's normal, above that
/// of the first. Throws InputError, naming the place, if it is more than kSameWall of the radius.
void require_same_plane(double height, double radius, const Plane& plane, const Place& place,
                        const std::string& what);

}  // namespace indet
