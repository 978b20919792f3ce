#include "libindet/exact/enclosure.h"

#include <cmath>
#include <limits>

namespace indet::exact {

Enclosure enclose(const mpq_class& value) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double truncated = value.get_d();  // towards zero
  if (std::isinf(truncated)) {
    const double largest = std::numeric_limits<double>::max();
    return value > 0 ? Enclosure{largest, kInfinity} : Enclosure{-kInfinity, -largest};
  }
  if (mpq_class(truncated) == value) return {truncated, truncated};
  if (value > 0) return {truncated, std::nextafter(truncated, kInfinity)};
  return {std::nextafter(truncated, -kInfinity), truncated};
}

bool contains(const Enclosure& bounds, const mpq_class& value) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto [lower, upper] = bounds;
  const bool above = lower == -kInfinity || (std::isfinite(lower) && mpq_class(lower) <= value);
  const bool below = upper == kInfinity || (std::isfinite(upper) && value <= mpq_class(upper));
  return above && below;
}

double nearest(const mpq_class& value) {
  const Enclosure enclosure = enclose(value);
  if (std::isinf(enclosure.lower) || std::isinf(enclosure.upper))
    return value > 0 ? enclosure.lower : enclosure.upper;
  const bool low =
      mpq_class(value - mpq_class(enclosure.lower)) <= mpq_class(mpq_class(enclosure.upper) - value);
  return low ? enclosure.lower : enclosure.upper;
}

}  // namespace indet::exact
