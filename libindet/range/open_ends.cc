#include "libindet/range/open_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libindet/polytope/central_polytope.h"
#include "libindet/range/barrier_ranges.h"

namespace indet {
namespace {

/// An infinite end becomes the one that is known of the other interval. Both contain the exact value.
void close(double& lower, double& upper, double stored, double known_lower, double known_upper) {
  if (std::isinf(lower) && std::isfinite(known_lower)) lower = std::min(stored, known_lower);
  if (std::isinf(upper) && std::isfinite(known_upper)) upper = std::max(stored, known_upper);
}

bool is_open(double lower, double upper) { return std::isinf(lower) || std::isinf(upper); }

}  // namespace

void close_open_ends(const Packing& packing, const std::vector<int>& contacts, const Extrema& extrema,
                     const FoundReactions& reactions, const IntervalOptions& options,
                     Enclosures& enclosures) {
  std::vector<int> open;
  for (const int i : contacts) {
    bool any = false;
    for (int column = 0; column < 4; ++column)
      any = any || (std::isfinite(extrema.value(i, column)) &&
                    is_open(enclosures.lower(i, column), enclosures.upper(i, column)));
    if (any) open.push_back(i);
  }
  const bool with_sums = std::any_of(enclosures.sums.begin(), enclosures.sums.end(),
                                     [](const SumBounds& sum) { return is_open(sum.lower, sum.upper); });
  if (open.empty() && !with_sums) return;
  const std::optional<ForcePolytope> sparse = find_sparse_polytope(packing);
  if (!sparse || !sparse->unbounded) return;
  const BarrierRanges found = find_barrier_ranges(packing, *sparse, open, {}, with_sums, options);
  for (const int i : open) {
    for (int column = 0; column < 4; ++column) {
      if (!std::isfinite(extrema.value(i, column))) continue;
      close(enclosures.lower(i, column), enclosures.upper(i, column), extrema.value(i, column),
            found.enclosures.lower(i, column), found.enclosures.upper(i, column));
    }
  }
  for (std::size_t k = 0; with_sums && k < enclosures.sums.size(); ++k) {
    const Eigen::Index row = reactions.entries[k] / 2;
    const int end = reactions.entries[k] % 2;
    // Sums are maxima, of the sum with the sign −1 where its least value is asked for.
    const double sign = end == 1 ? 1 : -1;
    const Reactions& known = found.reactions;
    const double lower = end == 1 ? known.lower(row, end) : -known.upper(row, end);
    const double upper = end == 1 ? known.upper(row, end) : -known.lower(row, end);
    close(enclosures.sums[k].lower, enclosures.sums[k].upper, sign * reactions.reactions.value(row, end),
          lower, upper);
  }
}

}  // namespace indet
