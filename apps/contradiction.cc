#include "apps/contradiction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libindet/base/counted.h"
#include "libindet/base/tolerances.h"
#include "libindet/packing/force_bounds.h"
#include "libindet/polytope/least_relaxation.h"

namespace indet::app {

std::vector<std::string> describe_contradiction(const Packing& packing, const ForceRanges& ranges) {
  const std::vector<ForceBound> bounds = force_bounds(packing);
  std::vector<std::string> lines;
  if (bounds.empty() || ranges.status != PolytopeStatus::kEmpty) return lines;
  const double mg = packing.force_unit();
  const Eigen::VectorXd& multipliers = ranges.bound_multipliers;
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    if (std::abs(multipliers[static_cast<Eigen::Index>(k)]) > tolerance::kMotionEntry) order.push_back(k);
  }
  if (order.empty()) return lines;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(multipliers[static_cast<Eigen::Index>(a)]) >
           std::abs(multipliers[static_cast<Eigen::Index>(b)]);
  });
  constexpr std::size_t kShown = 10;
  std::string names;
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i)
    names += fmt::format("{}{}", i > 0 ? "; " : "", bound_name(packing, bounds[order[i]], mg));
  if (order.size() > kShown) names += fmt::format("; and {} more", order.size() - kShown);
  if (ranges.doubtful) {
    lines.push_back(fmt::format(
        "Whether these bounds contradict each other cannot be told from rounding (mg): {}", names));
    return lines;
  }
  const std::optional<double> least = least_relaxation(packing);
  if (!least) return lines;  // without any bound it cannot stand either
  const std::string all = counted(static_cast<std::int64_t>(bounds.size()), "bound");
  lines.push_back(order.size() == 1
                      ? fmt::format("1 of {} contradicts balance and friction (mg): {}", all, names)
                      : fmt::format("{} of {} contradict each other, with balance and friction (mg): {}",
                                    order.size(), all, names));
  std::optional<double> common;  // the half interval, where all that have two ends have the same
  for (const ForceBound& bound : bounds) {
    if (!bound.is_two_sided()) continue;
    const double half = bound.half_interval() / mg;
    if (!common) common = half;
    if (!(std::abs(half - *common) <= tolerance::kSameError * *common)) common = std::nan("");
  }
  lines.push_back(
      fmt::format("They are compatible if each gives way by {:.3g} mg{}", *least,
                  common && std::isfinite(*common)
                      ? fmt::format(": the least error is {:.3g} mg, not {:.3g}", *common + *least, *common)
                      : ""));
  return lines;
}

}  // namespace indet::app
