#include "libindet/equilibrium/bound_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/tolerances.h"

namespace indet {

ForceUnits problem_units(const Packing& packing) {
  ForceUnits units = packing.force_units();
  double narrowest = std::numeric_limits<double>::infinity();
  for (const ForceBound& bound : force_bounds(packing)) {
    narrowest = std::min(narrowest, bound.half_interval());
  }
  if (!(narrowest < tolerance::kNarrowBounds * units.internal_in_scene())) return units;
  return {packing.force_unit(), std::exp2(std::round(std::log2(narrowest)))};
}

std::vector<BoundRow> rows_of(const std::vector<ForceBound>& bounds, double unit) {
  std::vector<BoundRow> rows;
  for (const ForceBound& bound : bounds) {
    BoundRow row{bound, bound.value / unit};
    if (row.follows_lower()) row.value = (bound.value - bound.other) / unit;
    rows.push_back(row);
  }
  return rows;
}

void add_to_bounds(const std::vector<BoundRow>& bounds, int first_row, ContactId contact, double R, double T,
                   int column, std::vector<Eigen::Triplet<double>>& out) {
  const auto begin =
      std::lower_bound(bounds.begin(), bounds.end(), contact.value(),
                       [](const BoundRow& row, int c) { return row.bound.contact.value() < c; });
  for (auto row = begin; row != bounds.end() && row->bound.contact == contact; ++row) {
    const double force = row->bound.tangential ? T : R;
    if (!row->follows_lower() && force != 0)
      out.emplace_back(first_row + static_cast<int>(row - bounds.begin()), column, force);
  }
}

void add_slack(const std::vector<BoundRow>& bounds, int first_row, int k, int column,
               std::vector<Eigen::Triplet<double>>& out) {
  const auto i = static_cast<std::size_t>(k);
  const bool is_lower = bounds[i].bound.side == ForceBound::Side::kLower;
  out.emplace_back(first_row + k, column, is_lower ? -1 : 1);
  if (i + 1 < bounds.size() && bounds[i + 1].follows_lower()) out.emplace_back(first_row + k + 1, column, 1);
}

}  // namespace indet
