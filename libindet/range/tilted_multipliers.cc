#include "libindet/range/tilted_multipliers.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/rounding_bounds.h"

namespace indet {
namespace {

/// What is smaller, relative to the largest velocity, is rounding.
constexpr double kResting = 0x1p-75;

std::vector<bool> moving_rows(std::span<const Doubled> y) {
  double largest = 0;
  for (const Doubled& velocity : y) largest = std::max(largest, std::abs(velocity.high));
  std::vector<bool> moves;
  for (const Doubled& velocity : y) moves.push_back(std::abs(velocity.high) > kResting * largest);
  return moves;
}

}  // namespace

std::optional<BasisSystem::Solution> tilted_multipliers(const DoubledEquations& equations,
                                                        const BasisSystem& system, const DoubledFunctional& g,
                                                        std::span<const Doubled> y,
                                                        const Eigen::VectorXd& strength) {
  const std::vector<bool> moves = moving_rows(y);
  DoubledFunctional ones;
  for (int k = 0; k < equations.columns(); ++k) {
    const auto column = equations.column(k);
    if (!system.active()[static_cast<std::size_t>(k)] &&
        std::any_of(column.begin(), column.end(),
                    [&](const auto& entry) { return moves[static_cast<std::size_t>(entry.row)]; }))
      ones.push_back({k, {1, 0}});
  }
  const std::vector<Doubled> tilt = system.multipliers(ones).value;
  for (const double share : {0x1p-84, 0x1p-76, 0x1p-66}) {
    std::vector<Doubled> tilted(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (moves[i]) tilted[i] = sum(y[i], share * tilt[i].high);
    }
    const Bounded left = equations.reduced_costs(g, tilted);
    const auto rises = (left.value + kWiden * left.error).array() > 0;
    if (!(rises && strength.array().isInf()).any()) return BasisSystem::Solution{tilted, left};
  }
  return {};
}

}  // namespace indet
