#include "apps/distance_report.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/ranges_json.h"
#include "libindet/base/constants.h"
#include "libindet/base/counted.h"
#include "libindet/base/tolerances.h"

namespace indet::app {
namespace {

/// Distances that are not known are left out.
nlohmann::json mean_of(const Eigen::VectorXd& values) {
  const auto known = values.array().isNaN().select(0, values.array());
  const auto count = static_cast<double>((!values.array().isNaN()).count());
  return json_number(count > 0 ? known.sum() / count : kNaN);
}

nlohmann::json largest_of(const Eigen::VectorXd& values) {
  double largest = kNaN;
  for (const double value : values) largest = std::fmax(largest, value);
  return json_number(largest);
}

}  // namespace

bool has_smallest_distances(const ForceRanges& ranges) { return ranges.smallest.outcome.rows() > 0; }

std::string describe_smallest_distances(const ForceRanges& ranges) {
  const SmallestDistances& smallest = ranges.smallest;
  const Eigen::Index known = smallest.count(Outcome::kEnclosed);
  const Eigen::Index imprecise = smallest.count(Outcome::kImprecise);
  const Eigen::Index failed = smallest.count(Outcome::kFailed);
  if (known + imprecise == 0 && failed > 0 && ranges.status != PolytopeStatus::kPoint) {
    const bool is_unbounded = ranges.status == PolytopeStatus::kUnbounded;
    return fmt::format(
        "no smallest distances: they are found from the centre of the polytope of contact states, which has "
        "none, because {}",
        is_unbounded ? "some contact forces can grow without limit" : "it is too thin");
  }
  return fmt::format("{} known to {:.2g} %, {} imprecise, {} failed", counted(known, "smallest distance"),
                     100 * tolerance::kDistanceGap, imprecise, failed);
}

nlohmann::json smallest_distances_to_json(const ForceRanges& ranges) {
  const SmallestDistances& smallest = ranges.smallest;
  return {{"known", smallest.count(Outcome::kEnclosed)}, {"imprecise", smallest.count(Outcome::kImprecise)},
          {"failed", smallest.count(Outcome::kFailed)},  {"mean_d_R_min", mean_of(smallest.d_R)},
          {"max_d_R_min", largest_of(smallest.d_R)},     {"mean_d_T_min", mean_of(smallest.d_T)},
          {"max_d_T_min", largest_of(smallest.d_T)}};
}

}  // namespace indet::app
