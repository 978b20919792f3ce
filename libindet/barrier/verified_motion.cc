#include "libindet/barrier/verified_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/stored_entries.h"
#include "libindet/base/rounding_bounds.h"

namespace indet::barrier {

bool proves_emptiness(const EquilibriumProblem& problem, const BlockStructure& structure,
                      std::span<const double> y) {
  const std::vector<double> entry_error = entry_rounding(problem, structure);
  const std::vector<double> load_error = load_rounding(problem, structure);
  const auto n = static_cast<std::size_t>(structure.columns());
  std::vector<double> power(n, 0), magnitude(n, 0), rounded(n, 0), terms(n, 2);
  for_each_entry(structure, [&](std::size_t column, std::size_t place, double entry) {
    power[column] += entry * y[place];
    magnitude[column] += std::abs(entry * y[place]);
    rounded[column] += entry_error[place] * std::abs(y[place]);
    terms[column] += 1;
  });
  for (std::size_t k = 0; k < n; ++k) {
    const double error = kWiden * kWiden * (kRoundoff * terms[k] * magnitude[k] + rounded[k]) + kTiny;
    if (!(power[k] > error)) return false;
  }
  const Dot work = accurate_dot(y, structure.load());
  double error = work.error;
  for (std::size_t i = 0; i < y.size(); ++i) error += std::abs(y[i]) * load_error[i];
  return work.value < -kWiden * kWiden * error;
}

std::optional<std::vector<double>> proven_motion(const EquilibriumProblem& problem,
                                                 const BlockStructure& structure, std::span<const double> y,
                                                 std::span<const double> y_1) {
  double largest = 0;
  for (const double velocity : y) largest = std::max(largest, std::abs(velocity));
  std::vector<double> scaled(y.begin(), y.end());
  for (double& velocity : scaled) velocity /= largest;
  double worst = 0;
  for (const double power : transposed_product(structure, scaled)) worst = std::max(worst, -power);
  // The largest leaves the most room for who proves it again.
  for (const double noise : {1e-12, 1e-13, 1e-14, 1e-15}) {
    std::vector<double> sum = scaled;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += (2 * worst + noise) * y_1[i];
    if (proves_emptiness(problem, structure, sum)) return sum;
  }
  return {};
}

}  // namespace indet::barrier
