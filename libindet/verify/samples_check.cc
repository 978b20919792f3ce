#include "libindet/verify/samples_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/tolerances.h"
#include "libindet/verify/samples_part.h"

namespace indet {
namespace {

struct Range {
  double low, high;  ///< mg; not finite where it is not known or not limited
};

Range range_of(const SamplesPart& part, Eigen::Index component) {
  const auto value = part.ranges->value.row(component / 2);
  const bool is_tangential = component % 2 == 1;
  return {value[is_tangential ? kMinT : kMinR] / part.ranges->force_unit,
          value[is_tangential ? kMaxT : kMaxR] / part.ranges->force_unit};
}

/// The centre lies in all ranges, and no sample of values between low and high has a variance above
/// (high − mean)(mean − low) (Bhatia and Davis).
void check_against_ranges(const SamplesPart& part) {
  if (part.ranges == nullptr || part.ranges->value.rows() != part.packing.contact_count()) return;
  const double rounding = tolerance::kRoundingRoom * part.scale;
  double most = 0;
  for (Eigen::Index k = 0; k < part.center.size(); ++k) {
    const Range range = range_of(part, k);
    const double mean = part.center[k];
    if (!std::isnan(range.low))
      part.compare.require(mean >= range.low - rounding,
                           "center: component {} is {} mg, its range begins at {}", k, mean, range.low);
    if (!std::isnan(range.high))
      part.compare.require(mean <= range.high + rounding,
                           "center: component {} is {} mg, its range ends at {}", k, mean, range.high);
    const double bound = std::max(0.0, range.high - mean) * std::max(0.0, mean - range.low);
    most += bound;
    if (!part.record.components || !std::isfinite(bound)) continue;
    const ComponentRecord& table = *part.record.components;
    const double deviation = table.deviation[k] / part.problem.force_unit();
    part.compare.require(deviation * deviation <= bound + rounding * part.scale,
                         "deviation: that of component {} is {} mg, more than its range allows", k,
                         deviation);
    for (const double value : table.quantiles.row(k) / part.problem.force_unit()) {
      part.compare.require(range.low - rounding <= value && value <= range.high + rounding,
                           "quantiles: {} mg of component {} is not within {} … {}", value, k, range.low,
                           range.high);
    }
  }
  const double r = part.number("r");
  if (std::isfinite(most))
    part.compare.require(r * r <= most + rounding * part.scale, "r: {} is more than the ranges allow", r);
}

void check_perturb(const SamplesPart& part) {
  Comparisons& compare = part.compare;
  const double samples = part.count("samples", 1);
  const double accepted = part.count("accepted");
  compare.require(accepted <= samples, "accepted: {} of {} samples", accepted, samples);
  compare.require(part.count("converged") <= samples, "converged: {} of {} samples", part.number("converged"),
                  samples);
  compare.require(part.count("chains", 1) <= samples, "chains: {} for {} samples", part.number("chains"),
                  samples);
  compare.require(part.number("width") > 0 && part.number("width") <= 1, "width: {} is not within 0 … 1",
                  part.number("width"));
  if (accepted < samples)
    compare.remark(fmt::format("{:.0f} of {:.0f} solutions not accepted, and left out of the sample",
                               samples - accepted, samples));
  if (accepted == 0) {
    for (const char* name : {"r", "r_error", "spread", "start_distance"})
      compare.equal(part.number(name), -1, name);
    return;
  }
  // The residual is convex: that of a mean is at most the largest of those whose mean it is.
  const double worst = part.number("worst_residual");
  const double residual = compare.add_state(part.problem, part.center);
  part.require_in("worst_residual", 0, tolerance::kAcceptedSolution * part.problem.internal_unit());
  compare.require(residual <= std::max(worst, 0.0) + tolerance::kAgreement * part.scale,
                  "center: it violates equilibrium or contact conditions by {} mg, the samples by at most {}",
                  residual, worst);
  compare.equal(part.number("start_distance"), (part.start() - part.center).norm(), "start_distance",
                tolerance::kAgreement, part.scale);
  // A mean square is at least (mean)², so that spread ≤ r; and at most one of n squares can be n times it.
  const double r = part.number("r");
  part.require_in("worst_raw_residual", 0, std::numeric_limits<double>::infinity());
  part.require_in("spread", 0, r);
  part.require_in("r_error", 0, r / 2);
  compare.leave_unchecked(
      "r, r_error, spread, worst_residual, worst_raw_residual, accepted, converged (the solutions are not "
      "stored; bounds were checked); seed, width, chains (solutions are not found again)");
}

void check_uniform(const SamplesPart& part) {
  const double residual = part.compare.add_state(part.problem, part.center);
  part.compare.require(residual <= tolerance::kPrimalResidual * part.scale,
                       "center: it violates equilibrium or contact conditions by {} mg", residual);
  check_uniform_numbers(part);
  const bool is_point = part.number("dim") == 0;
  part.compare.require(is_point != part.record.components.has_value(), "dim: {} and {} of single forces",
                       part.number("dim"), is_point ? "tables" : "no tables");
  if (part.record.components) check_components(part);
  if (part.record.components && has_whole_sample(part)) check_whole_sample(part);
}

}  // namespace

Verification verify_samples(const Packing& packing, const SamplingRecord& record, const std::string& place,
                            const ForceRanges* ranges) {
  Comparisons compare(place);
  const Eigen::Index components = 2 * static_cast<Eigen::Index>(packing.contact_count());
  const bool fits = compare.require(record.center.size() == components, "center: {} numbers for {} contacts",
                                    record.center.size(), packing.contact_count()) &&
                    compare.require(!record.components || record.components->deviation.size() == components,
                                    "deviation: its size is not that of the centre");
  if (!fits) return compare.result();
  const RebuiltProblem problem(packing);
  const SamplesPart part{packing, record, ranges, problem, compare};
  const bool is_uniform = record.method == "uniform";
  if (!compare.require(is_uniform || record.method == "perturb", "method: \"{}\" is unknown", record.method))
    return compare.result();
  is_uniform ? check_uniform(part) : check_perturb(part);
  if (is_uniform || part.number("accepted") > 0) check_against_ranges(part);
  return compare.result();
}

}  // namespace indet
