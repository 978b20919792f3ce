#pragma once

#include <limits>

namespace indet {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A value that is not known, or that there is not.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace indet
