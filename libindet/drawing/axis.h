#pragma once

#include <cmath>

namespace indet {

/// 1, 2 or 5 times a power of ten, with about four of them in twice `reach`. Precondition: reach > 0.
double tick_step(double reach);

/// Calls draw(multiple) for the multiples of `step` between two numbers, in order.
template <class Draw>
void for_each_tick(double from, double to, double step, Draw draw) {
  for (double k = std::ceil(from / step); k * step <= to; ++k) draw(k * step);
}

}  // namespace indet
