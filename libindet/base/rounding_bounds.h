#pragma once

#include <span>

namespace indet {

constexpr double kRoundoff = 0x1p-53;  ///< unit roundoff u
constexpr double kTiny = 0x1p-600;     ///< above anything that underflow can lose
/// Bounds are sums of few positive terms; this factor covers their own rounding.
constexpr double kWiden = 1 + 0x1p-40;

/// x·y in twice the precision, with an error below `error` (Dot2 of Ogita, Rump and Oishi).
struct Dot {
  double value = 0;
  double error = 0;
};
/// Precondition: of one length.
Dot accurate_dot(std::span<const double> x, std::span<const double> y);

}  // namespace indet
