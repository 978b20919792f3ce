#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/verify/affine_hull.h"
#include "libindet/verify/samples_part.h"

namespace indet {
namespace {

/// Percentages of the samples whose value is smaller than that of the simulated state.
constexpr std::array kPercentiles = {"start_distance_percentile", "start_norm_percentile",
                                     "start_normal_force_percentile", "start_mobilisation_percentile",
                                     "start_R_star_percentile"};

/// Chains record one state every `interval` sweeps; the first fifth is left out. Steps are sweeps of all
/// chains, and of the warm-up, times dim F.
void check_account_of_sweeps(const SamplesPart& part) {
  const double samples = part.count("samples", 1);
  const double chains = part.count("chains", 2);
  const double interval = part.count("interval", 1);
  const double sweeps = part.count("sweeps", 1);
  const double recorded = sweeps / interval;
  const double expected = chains * (recorded - std::floor(recorded / 5));
  part.compare.require(samples == expected && recorded == std::floor(recorded),
                       "samples: {} are stored, but {} chains that record every {} of {} sweeps have {}",
                       samples, chains, interval, sweeps, expected);
  const double warm_up = part.count("steps") / part.number("dim") - sweeps * chains;
  part.compare.require(warm_up >= 0 && warm_up == std::floor(warm_up),
                       "steps: {} are not those of {} chains of {} sweeps and a warm-up",
                       part.number("steps"), chains, sweeps);
  part.count("warm_up_phases");
  part.require_in("requested", 100, 1e6);
}

void check_size(const SamplesPart& part) {
  Comparisons& compare = part.compare;
  const double r = part.number("r");
  const double norm = part.center.norm();
  part.require_in("r", 0, kInfinity);
  part.require_in("r_error", 0, kInfinity);
  part.require_in("spread", 0, r);
  // ‖F‖ does not vary more than F does.
  part.require_in("norm_deviation", 0, r);
  compare.equal(std::hypot(part.number("mean_norm"), part.number("norm_deviation")), std::hypot(norm, r),
                "mean_norm and norm_deviation together", tolerance::kSizeAgreement, part.scale);
}

void check_dimension(const SamplesPart& part) {
  const double dim = part.count("dim");
  const std::optional<AffineHull> hull = AffineHull::at(part.problem, part.center);
  if (!hull) {
    part.require_in("dim", 0, part.problem.nullity());
    part.compare.leave_unchecked("dim, blocks (rounding hides them)");
    return;
  }
  part.compare.equal(dim, hull->dim(), "dim");
  if (const std::optional<int> blocks = hull->blocks()) {
    part.compare.equal(part.number("blocks"), *blocks, "blocks");
  } else {
    part.compare.leave_unchecked("blocks (rounding hides them)");
  }
}

void check_start(const SamplesPart& part) {
  Comparisons& compare = part.compare;
  if (!compare.require(
          part.has("start_distance") == part.packing.has_simulated_forces(),
          "start_distance: is there although forces are unknown, or missing although they are known") ||
      !part.has("start_distance")) {
    return;
  }
  const Eigen::VectorXd start = part.start();
  compare.equal(part.number("start_distance"), (start - part.center).norm(), "start_distance",
                tolerance::kAgreement, part.scale);
  const auto sliding = part.problem.count_sliding(start).sliding;
  compare.equal(part.number("start_sliding"), sliding, "start_sliding");
  const double most = part.count("most_sliding");
  compare.require(most <= 2 * part.packing.contact_count(), "most_sliding: {} of {} contacts", most,
                  part.packing.contact_count());
  const double samples = part.number("samples");
  const auto is_part_of_samples = [&](const char* name, double parts) {
    const double percentage = part.number(name);
    const double smaller = percentage / 100 * parts * samples;
    compare.require(percentage >= 0 && percentage <= 100 &&
                        std::abs(smaller - std::round(smaller)) < tolerance::kWholeCount,
                    "{}: {} is not a percentage of {} samples", name, percentage, samples);
  };
  for (const char* name : kPercentiles) {
    const bool is_known = !std::isnan(part.number(name));
    if (part.has(name) && is_known) is_part_of_samples(name, 1);
  }
  is_part_of_samples("start_sliding_percentile", 2);
  if (most == 0) {
    compare.equal(part.number("start_sliding_percentile"), sliding > 0 ? 100 : 50,
                  "start_sliding_percentile");
  } else if (sliding > most) {
    compare.equal(part.number("start_sliding_percentile"), 100, "start_sliding_percentile");
  }
}

/// The mean over contacts with a range of the place of R in it.
void check_mean_place(const SamplesPart& part) {
  if (part.ranges == nullptr || !part.has("start_mean_R_star")) return;
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < part.ranges->value.rows(); ++i) {
    const double low = part.ranges->value(i, kMinR) / part.ranges->force_unit;
    const double width = part.ranges->value(i, kMaxR) / part.ranges->force_unit - low;
    if (!std::isfinite(width) || !(width > part.epsilon())) continue;
    const double R = part.packing[ContactId(static_cast<int>(i))].R / part.problem.force_unit();
    sum += (R - low) / width;
    ++count;
  }
  part.compare.equal(part.number("start_mean_R_star"), count > 0 ? sum / count : Verification::kNaN,
                     "start_mean_R_star", tolerance::kSumAgreement);
}

/// The logarithm of the volume of a ball.
double log_ball(double radius, double dim) {
  return dim / 2 * std::log(std::numbers::pi) - std::lgamma(dim / 2 + 1) + dim * std::log(radius);
}

/// Every width of F is at least the diameter of the ball in it, and at most that of F; its volume is at least
/// that of the ball, and at most that of a ball of its diameter.
void check_shape(const SamplesPart& part) {
  Comparisons& compare = part.compare;
  if (!part.has("diameter_lower")) return;
  const double ball = 2 * part.number("inscribed_radius");
  const double rounding = 1 + tolerance::kRoundingRoom;
  const double lower = part.number("diameter_lower");
  const double upper = part.number("diameter_upper");
  const double unsolved = part.count("unsolved_widths");
  part.require_in("diameter_lower", ball / rounding, kInfinity);
  if (unsolved == 0) {
    compare.require(lower <= upper * rounding, "diameter: its bounds {} and {} exclude each other", lower,
                    upper);
    part.require_in("mean_width", ball / rounding, upper * rounding);
    part.require_in("mean_width_error", 0, kInfinity);
  } else {
    compare.call_unsolved(fmt::format("{:.0f} linear programs for widths not solved", unsolved));
  }
  const double by_ranges = part.number("diameter_by_ranges");
  if (!std::isnan(by_ranges))
    compare.require(!(upper > by_ranges * rounding), "diameter_upper: {} is above diameter_by_ranges {}",
                    upper, by_ranges);
  const double volume = part.number("log_volume");
  const double error = 6 * part.number("log_volume_error");
  const double dim = part.number("dim");
  part.require_in("log_volume_error", 0, kInfinity);
  part.count("volume_phases");
  compare.require(
      volume >= log_ball(ball / 2, dim) - error &&
          (std::isnan(upper) || volume <= log_ball(upper / 2, dim) + error),
      "log_volume: {} is not between those of balls with the inscribed radius and with the diameter", volume);
  compare.leave_unchecked(
      "diameter_lower, diameter_upper, diameter_by_ranges, mean_width, mean_width_error, log_volume, "
      "log_volume_error, volume_phases, unsolved_widths (linear programs and walks are not repeated; bounds "
      "were checked)");
}

}  // namespace

void check_uniform_numbers(const SamplesPart& part) {
  check_dimension(part);
  check_size(part);
  if (part.number("dim") == 0) {
    for (const char* name : {"r", "r_error", "spread", "norm_deviation"})
      part.compare.equal(part.number(name), 0, name);
    part.compare.equal(part.number("converged"), 1, "converged");
    if (part.has("worst_residual"))
      part.compare.equal(part.number("worst_residual"), part.problem.imbalance(part.center), "worst_residual",
                         tolerance::kAgreement, part.scale);
    part.compare.leave_unchecked("seed (of a point nothing is drawn)");
    return;
  }
  check_account_of_sweeps(part);
  check_start(part);
  check_mean_place(part);
  part.require_in("worst_slack", -tolerance::kPrimalResidual * part.scale, kInfinity);
  part.require_in("inscribed_radius", 0, kInfinity);
  check_shape(part);
  part.compare.leave_unchecked(
      "inscribed_radius, worst_slack, seed, requested, warm_up_phases, steps, interval, sweeps (linear "
      "programs "
      "and walks are not repeated; bounds were checked)");
}

}  // namespace indet
