#include "libindet/verify/draws_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"
#include "libindet/statistics/draw_estimate.h"
#include "libindet/statistics/probability_laws.h"
#include "libindet/verify/rebuilt_ellipsoid.h"

namespace indet {
namespace {

constexpr int kMostWidths = 500;  ///< each takes some solves

class DrawsCheck {
 public:
  DrawsCheck(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
             Comparisons& compare)
      : packing_(packing), ranges_(ranges), problem_(problem), compare_(compare) {}

  void run() {
    check_centre();
    check_weights();
    check_drawn();
    check_estimate(ranges_.sample_R, ranges_.delta_R, "delta_R");
    check_estimate(ranges_.sample_T, ranges_.delta_T, "delta_T");
  }

 private:
  void check_centre() {
    const Eigen::VectorXd centre =
        Eigen::Map<const Eigen::VectorXd>(ranges_.centre.data(), ranges_.centre.size()) / ranges_.force_unit;
    const double scale = std::max(problem_.internal_unit(), centre.lpNorm<Eigen::Infinity>());
    const double imbalance = problem_.imbalance(centre) / scale;
    compare_.require(imbalance <= tolerance::kDrawCentre, "centre: its forces do not balance ({})",
                     imbalance);
    if (imbalance > tolerance::kDrawCentre) return;
    const auto ellipsoid = RebuiltEllipsoid::about(problem_, centre, tolerance::kTightHalfPlane * scale);
    if (!ellipsoid) {
      compare_.leave_unchecked("width of /ranges (the centre lies on a half-plane that is closed)");
      return;
    }
    const double away = ellipsoid->decrement();
    compare_.require(away <= tolerance::kDrawCentre, "centre: the analytic centre is elsewhere ({})", away);
    const int step = (packing_.contact_count() + kMostWidths - 1) / kMostWidths;
    for (int i = 0; i < packing_.contact_count(); i += step) {
      for (const int k : {0, 1}) {
        const double width = ranges_.width(i, k) / ranges_.force_unit;
        compare_.equal(width, ellipsoid->width(2 * i + k),
                       fmt::format("width of {} of contact {}", k == 0 ? "R" : "T", i),
                       tolerance::kDrawCentre, scale);
      }
    }
    if (step > 1) compare_.leave_unchecked(fmt::format("width of /ranges, but for one in {} contacts", step));
  }

  void check_weights() {
    const Eigen::Index count = ranges_.weight.size();
    double sum[2] = {0, 0};
    for (Eigen::Index i = 0; i < count; ++i) {
      for (const int k : {0, 1}) sum[k] += ranges_.width(i, k);
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      double relative = 0;
      for (const int k : {0, 1})
        relative += sum[k] > 0 ? ranges_.width(i, k) * static_cast<double>(count) / sum[k] : 0;
      compare_.require(
          std::abs(ranges_.weight[i] - 2 - 100 * relative) <= 0.5 + tolerance::kAgreement * relative,
          "draw_weight: {} of contact {} does not follow from its widths", ranges_.weight[i], i);
    }
  }

  /// Draw after draw: the number falls into the interval of one contact.
  void check_drawn() {
    const std::int64_t total = ranges_.weight.cast<std::int64_t>().sum();
    std::vector<int> times(static_cast<std::size_t>(ranges_.weight.size()), 0);
    Random random(static_cast<std::uint64_t>(ranges_.sample_seed));
    for (int k = 0; k < ranges_.draws; ++k) {
      auto left = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(total)));
      std::size_t contact = 0;
      while (left >= ranges_.weight[static_cast<Eigen::Index>(contact)])
        left -= ranges_.weight[static_cast<Eigen::Index>(contact++)];
      ++times[contact];
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      compare_.equal_count(ranges_.drawn[row], times[i], fmt::format("drawn of contact {}", i));
      const bool is_left_out = ranges_.outcome(row, kMinR) == Outcome::kNotRequested;
      compare_.require(is_left_out == (ranges_.drawn[row] == 0), "contact {}: drawn {} times, but {}", i,
                       ranges_.drawn[row], is_left_out ? "left out" : "not left out");
    }
  }

  /// Moments by pairs: Σ (z_i − z_j)² = 2K(K − 1) s².
  void check_estimate(const SampleEstimate& stored, const Eigen::VectorXd& delta, const std::string& name) {
    std::vector<double> z;
    const double total = ranges_.weight.cast<double>().sum();
    for (Eigen::Index i = 0; i < delta.size(); ++i) {
      const double mean_weight = total / static_cast<double>(delta.size());
      z.insert(z.end(), static_cast<std::size_t>(ranges_.drawn[i]),
               delta[i] * mean_weight / ranges_.weight[i]);
    }
    const auto count = static_cast<double>(z.size());
    double sum = 0;
    double pairs = 0;
    for (const double a : z) {
      sum += a;
      for (const double b : z) pairs += (a - b) * (a - b);
    }
    const double mean = sum / count;
    double reach = Verification::kNaN;
    if (count >= kFewestForInterval)
      reach =
          student_quantile(count - 1, (1 + kConfidence) / 2) * std::sqrt(pairs / (2 * (count - 1))) / count;
    compare_.equal(stored.mean, mean, "mean_" + name);
    compare_.equal(stored.low, mean - reach, "lower end of mean_" + name);
    compare_.equal(stored.high, mean + reach, "upper end of mean_" + name);
    const double band = kBandBias + kBandNoise / std::sqrt(count);
    compare_.equal(stored.band, std::isnan(mean) ? mean : band, "band_" + name);
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const RebuiltProblem& problem_;
  Comparisons& compare_;
};

}  // namespace

void check_draws(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                 Comparisons& compare) {
  DrawsCheck(packing, ranges, problem, compare).run();
}

}  // namespace indet
