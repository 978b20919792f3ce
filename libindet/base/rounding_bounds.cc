#include "libindet/base/rounding_bounds.h"

#include <cmath>
#include <cstddef>

namespace indet {

Dot accurate_dot(std::span<const double> x, std::span<const double> y) {
  double sum = 0;
  double correction = 0;
  double magnitude = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double product = x[i] * y[i];
    const double low = std::fma(x[i], y[i], -product);
    const double next = sum + product;
    const double part = next - sum;
    correction += ((sum - (next - part)) + (product - part)) + low;
    sum = next;
    magnitude += std::abs(product);
  }
  const double n = static_cast<double>(x.size() + 1) * kRoundoff;
  Dot dot;
  dot.value = sum + correction;
  dot.error = kWiden * (kRoundoff * std::abs(dot.value) + 4 * n * n * magnitude) + kTiny;
  return dot;
}

}  // namespace indet
