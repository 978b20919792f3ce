#pragma once

#include <Eigen/Core>

namespace indet {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

}  // namespace indet
