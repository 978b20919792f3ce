#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "libindet/base/constants.h"

namespace indet::barrier {

inline std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Precondition: of one length.
inline double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// max |value|; infinite if some value is no number.
inline double largest_entry(std::span<const double> values) {
  double result = 0;
  for (const double value : values)
    result = std::isnan(value) ? kInfinity : std::max(result, std::abs(value));
  return result;
}

inline void multiply_by(std::span<double> values, double factor) {
  for (double& value : values) value *= factor;
}

}  // namespace indet::barrier
