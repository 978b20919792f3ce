#include "apps/ensemble/presentation/smallest_distance_summary.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/ensemble/presentation/samples.h"
#include "apps/ensemble/presentation/which_states.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Smallest distance over distance, of the contacts whose force is not determined.
GroupedValues ratio_of(const GroupedValues& smallest, const GroupedValues& distance) {
  GroupedValues ratio;
  for (std::size_t i = 0; i < distance.values.size(); ++i) {
    if (distance.values[i] > 0) ratio.add(smallest.values[i] / distance.values[i], distance.group[i]);
  }
  return ratio;
}

}  // namespace

std::string known_smallest_distances(const EnsembleTables& tables) {
  const double known = tables.runs.sum("d_min_known");
  const double imprecise = tables.runs.sum("d_min_imprecise");
  const double failed = tables.runs.sum("d_min_failed");
  const double all = known + imprecise + failed;
  if (all == 0) return "";
  return fmt::format("{} of {} known to {:.2g} %, {} imprecise, {} failed", known, all,
                     100 * tolerance::kDistanceGap, imprecise, failed);
}

void add_smallest_distances(const EnsembleTables& tables, std::vector<Comparison>& rows) {
  const std::string known = known_smallest_distances(tables);
  if (known.empty()) return;
  rows.push_back({"smallest distances", "", known, ""});
  const Samples samples(tables);
  const auto values = [&](const char* column) { return samples.of(samples.protocols(), column); };
  for (const WhichStates& choice : kChoicesOfStates) {
    const Estimate mean_R = grouped_mean(values(choice.normal));
    const Estimate mean_T = grouped_mean(values(choice.tangential));
    if (std::isnan(mean_R.value) || std::isnan(mean_T.value)) continue;
    rows.push_back({fmt::format("dR, dT: {}", choice.name), "",
                    fmt::format("mean {}, {}", text_of(mean_R, 1, "mg"), text_of(mean_T, 1, "mg")), ""});
  }
  const GroupedValues ratio = ratio_of(values(kNearestChoice.normal), values(kCanonicalChoice.normal));
  if (ratio.total() == 0) return;
  rows.push_back({"smallest over canonical dR", "",
                  fmt::format("median {:.2f}, a tenth below {:.2f}, a tenth above {:.2f}",
                              quantile(ratio, 0.5), quantile(ratio, 0.1), quantile(ratio, 0.9)),
                  ""});
}

}  // namespace indet
