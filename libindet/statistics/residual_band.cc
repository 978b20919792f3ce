#include "libindet/statistics/residual_band.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

double mean_residual(std::span<const double> values) {
  return values.empty()
             ? 0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

int fewest_for_conformal(double coverage) {
  return static_cast<int>(std::ceil(coverage / (1 - coverage) - tolerance::kWholeNumber));
}

ResidualBand conformal_band(std::span<const double> residuals, double coverage) {
  const auto count = static_cast<double>(residuals.size());
  const auto n =
      static_cast<std::ptrdiff_t>(std::floor((1 - coverage) * (count + 1) + tolerance::kWholeNumber));
  const double centre = mean_residual(residuals);
  const double mirror = (count + 1) / (count - 1);
  std::vector<double> above, below;
  for (const double residual : residuals) {
    const double away = residual - centre;
    above.push_back(std::max(away, -mirror * away));
    below.push_back(std::min(away, -mirror * away));
  }
  std::nth_element(above.begin(), above.begin() + (n - 1), above.end(), std::greater<>());
  std::nth_element(below.begin(), below.begin() + (n - 1), below.end());
  return {centre, centre + below[static_cast<std::size_t>(n - 1)],
          centre + above[static_cast<std::size_t>(n - 1)]};
}

ResidualBand band_by_law(std::span<const double> residuals, const ResidualLaw& law) {
  const double shared = law.shared * law.shared;
  const double total = static_cast<double>(residuals.size()) * shared + 1;
  const double middle = mean_residual(residuals) * (1 - 1 / total);
  const double deviation = std::sqrt(1 + shared / total);
  return {middle, middle + deviation * law.low, middle + deviation * law.high};
}

}  // namespace indet
