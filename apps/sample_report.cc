#include "apps/sample_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "apps/ranges_json.h"
#include "apps/say.h"
#include "apps/wording.h"

namespace indet::app {

nlohmann::json sample_to_json(const ForceRanges& ranges) {
  nlohmann::json json = {{"seed", ranges.sample_seed}, {"confidence", kConfidence}};
  if (ranges.draws > 0) {
    json["draws"] = ranges.draws;
    json["estimator"] = to_string(ranges.estimator);
  }
  for (const auto& [name, estimate] : {std::pair("delta_R", ranges.sample_R), {"delta_T", ranges.sample_T}}) {
    json[name] = {{"mean", json_number(estimate.mean)},
                  {"low", json_number(estimate.low)},
                  {"high", json_number(estimate.high)},
                  {"band", json_number(estimate.band)}};
  }
  return json;
}

void print_sample(const Packing& packing, const ForceRanges& ranges) {
  say("\nestimate for all {}, from {} drawn at random (seed {}), with {:.0f} % confidence\n",
      counted(packing.contact_count(), "contact"), ranges.requested, ranges.sample_seed, 100 * kConfidence);
  if (ranges.draws > 0) {
    say("  {} with replacement, with probabilities that follow the widths about the analytic centre\n",
        counted(ranges.draws, "draw"));
    if (ranges.estimator == DrawEstimator::kRegression)
      say("  means by regression on predictions of δ from these widths\n");
  }
  const int count = ranges.draws > 0 ? ranges.draws : ranges.requested;
  for (const auto& [name, e] : {std::pair("δR", ranges.sample_R), {"δT", ranges.sample_T}}) {
    if (std::isnan(e.low)) {
      const bool is_small = count < kFewestForInterval;
      say("  {}   mean {:.4g} {}; no confidence interval{}\n", name, e.mean,
          ranges.draws > 0 ? "by the draws" : "in the sample",
          is_small ? fmt::format(" (--contacts sample:{} or more gives one)", kFewestForInterval) : "");
    } else {
      say("  {}   mean between {:.4g} and {:.4g}; distribution function known to ± {:.2g}{}\n", name, e.low,
          e.high, e.band, ranges.draws > 0 ? " by experience" : "");
    }
  }
}

}  // namespace indet::app
