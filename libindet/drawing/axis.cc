#include "libindet/drawing/axis.h"

#include <initializer_list>

namespace indet {

double tick_step(double reach) {
  const double power = std::pow(10.0, std::floor(std::log10(reach / 2)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= reach / 2) return factor * power;
  }
  return power;
}

}  // namespace indet
