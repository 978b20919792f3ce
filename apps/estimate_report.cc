#include "apps/estimate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/ranges_json.h"
#include "apps/say.h"
#include "apps/wording.h"
#include "libindet/statistics/residual_band.h"

namespace indet::app {
namespace {

/// Of the contacts that have an estimate.
struct Overview {
  int count = 0;
  double mean = std::nan(""), max = std::nan("");
  /// Medians of low/estimate and of high/estimate.
  double below = std::nan(""), above = std::nan("");
};

double median(std::vector<double>& values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Overview overview(const DeltaEstimates& estimates) {
  Overview result;
  double sum = 0;
  std::vector<double> below, above;
  for (Eigen::Index i = 0; i < estimates.estimate.size(); ++i) {
    const double estimate = estimates.estimate[i];
    if (std::isnan(estimate)) continue;
    ++result.count;
    sum += estimate;
    result.max = std::fmax(result.max, estimate);
    below.push_back(estimates.low[i] / estimate);
    above.push_back(estimates.high[i] / estimate);
  }
  if (result.count > 0) result.mean = sum / result.count;
  result.below = median(below);
  result.above = median(above);
  return result;
}

/// Forces that were found to be the same in every state.
std::int64_t determined_forces(const ForceRanges& ranges) { return ranges.determined / 2; }

}  // namespace

nlohmann::json estimates_to_json(const ForceRanges& ranges) {
  nlohmann::json json = {{"calibration", ranges.calibration},
                         {"calibrated_on", ranges.requested},
                         {"coverage", ranges.coverage}};
  if (ranges.sample_seed >= 0) json["seed"] = ranges.sample_seed;
  for (const auto& [name, estimates] :
       {std::pair("delta_R", &ranges.estimated_R), {"delta_T", &ranges.estimated_T}}) {
    const Overview all = overview(*estimates);
    json[name] = {{"estimated", all.count},
                  {"mean", json_number(all.mean)},
                  {"max", json_number(all.max)},
                  {"typical_low", json_number(all.below)},
                  {"typical_high", json_number(all.above)}};
  }
  return json;
}

void print_estimates(const Packing& packing, const ForceRanges& ranges) {
  const auto& R = ranges.estimated_R;
  const auto& T = ranges.estimated_T;
  say("\nestimates of δR and δT (mg), not found but predicted from the widths about the analytic centre\n");
  for (const auto& [name, estimates] : {std::pair("δR", &R), {"δT", &T}}) {
    const Overview all = overview(*estimates);
    say("  {}   of {}: mean {:.4g}, max {:.4g}", name, counted(all.count, "contact"), all.mean, all.max);
    if (all.count > 0)
      say("; {:.0f} % interval from {:.2g} to {:.2g} times the estimate, as a rule", 100 * ranges.coverage,
          all.below, all.above);
    say("\n");
  }
  if (ranges.requested == 0) {
    say("  by coefficients of other packings alone: they hold for packings like these; --calibrate {} or "
        "more "
        "holds for any\n",
        fewest_for_conformal(ranges.coverage));
  } else {
    say("  calibrated on {} drawn at random (seed {}), whose ranges were found\n",
        counted(ranges.requested, "contact"), ranges.sample_seed);
    if (ranges.requested < fewest_for_conformal(ranges.coverage))
      say("  too few for intervals that hold for any packing (from {} on)\n",
          fewest_for_conformal(ranges.coverage));
  }
  if (determined_forces(ranges) > 0)
    say("  {} the same in every state\n", determined_forces(ranges) == 1
                                              ? "1 force is"
                                              : fmt::format("{} forces are", determined_forces(ranges)));
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < R.estimate.size(); ++i) {
    if (!std::isnan(R.estimate[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return R.estimate[a] > R.estimate[b]; });
  if (order.empty()) return;
  constexpr std::size_t kShown = 5;
  order.resize(std::min(kShown, order.size()));
  say("\nlargest estimated δR      contact     bodies             δR between            δT between   (mg)\n");
  for (const Eigen::Index i : order) {
    say("{:>20.4g} {:>12}     {:<12} {:>8.4g} and {:>8.4g}  {:>8.4g} and {:>8.4g}\n", R.estimate[i], i,
        contact_name(packing, ContactId(i)), R.low[i], R.high[i], T.low[i], T.high[i]);
  }
}

std::string describe_estimates(const ForceRanges& ranges) {
  if (ranges.requested == 0) return "estimated by stored coefficients";
  return fmt::format("estimated, calibrated on {}", counted(ranges.requested, "contact"));
}

}  // namespace indet::app
