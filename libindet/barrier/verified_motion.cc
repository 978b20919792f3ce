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

bool proves_emptiness(const EquilibriumProblem& problem, const BlockStructure& structure,
                      std::span<const double> y, std::span<const double> y_1) {
  const std::vector<double> power = transposed_product(structure, y);
  double worst = 0, largest = 0;
  for (const double value : power) worst = std::max(worst, -value);
  for (const double value : y) largest = std::max(largest, std::abs(value));
  for (const double noise : {1e-15, 1e-14, 1e-13, 1e-12}) {
    const double epsilon = 2 * worst + noise * largest;
    std::vector<double> sum(y.begin(), y.end());
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += epsilon * y_1[i];
    if (proves_emptiness(problem, structure, sum)) return true;
  }
  return false;
}

}  // namespace indet::barrier
