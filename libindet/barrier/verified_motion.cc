#include "libindet/barrier/verified_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/base/rounding_bounds.h"

namespace indet::barrier {
namespace {

/// Of an entry of A in the row of this equation: stored doubles, or rounded a few times; those of stress are
/// f·l/L with |f| ≤ √2, |l|/L ≤ 3/2.
double rounding_of_entry(const EquilibriumRow& equation) {
  return (equation.body.is_cell() ? 24 : 8) * kRoundoff;
}

/// Calls visit(column, place, entry) for every entry of A, zeros of blocks too.
template <class Visit>
void visit_entries(const BlockStructure& s, Visit visit) {
  for (const BlockStructure::Group& group : s.groups()) {
    for (int e = 0; e < group.columns; ++e) {
      for (int t = group.first_touch; t < group.end_touch; ++t) {
        const BlockStructure::Touch& touch = s.touches()[static_cast<std::size_t>(t)];
        for (int r = 0; r < touch.rows; ++r) {
          visit(static_cast<std::size_t>(group.first_column + e),
                static_cast<std::size_t>(touch.first_row + r),
                s.coefficients()[static_cast<std::size_t>(touch.coefficients + e * touch.rows + r)]);
        }
      }
    }
  }
}

}  // namespace

bool proves_emptiness(const EquilibriumProblem& problem, const BlockStructure& structure,
                      std::span<const double> y) {
  const auto equation = [&](std::size_t place) -> const EquilibriumRow& {
    return problem.rows[static_cast<std::size_t>(structure.equation_of_place()[place])];
  };
  const auto n = static_cast<std::size_t>(structure.columns());
  std::vector<double> power(n, 0), magnitude(n, 0), rounded(n, 0), terms(n, 2);
  visit_entries(structure, [&](std::size_t column, std::size_t place, double entry) {
    power[column] += entry * y[place];
    magnitude[column] += std::abs(entry * y[place]);
    rounded[column] += rounding_of_entry(equation(place)) * std::abs(y[place]);
    terms[column] += 1;
  });
  for (std::size_t k = 0; k < n; ++k) {
    const double error = kWiden * kWiden * (kRoundoff * terms[k] * magnitude[k] + rounded[k]) + kTiny;
    if (!(power[k] > error)) return false;
  }
  const Dot work = accurate_dot(y, structure.load());
  double error = work.error;
  for (std::size_t i = 0; i < y.size(); ++i)
    error += std::abs(y[i]) * (6 * kRoundoff * equation(i).load / equation(i).unit + kTiny);
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
