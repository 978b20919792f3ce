#include "libindet/limit/limit_step.h"

#include <cmath>

namespace indet {

bool LimitStep::is_certain() const {
  if (dim < 0 || is_doubtful != 0 || imprecise != 0 || failed != 0) return false;
  return converged == -1 || (converged == 1 && std::isfinite(mean_width));
}

std::vector<double> step_values(double present, double limit, int steps) {
  std::vector<double> values;
  for (int k = 0; k < steps; ++k) values.push_back(present + k * (limit - present) / steps);
  values.push_back(present + (1 - kStepBeforeLimit) * (limit - present));
  return values;
}

}  // namespace indet
