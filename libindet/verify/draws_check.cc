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
#include "libindet/verify/centre_check.h"
#include "libindet/verify/rebuilt_predictions.h"

namespace indet {
namespace {

/// The line z(u) of least squares.
struct Line {
  double middle_u = 0, middle_z = 0, slope = 0;
  double squares = 0;  ///< Σ (u − middle_u)²

  static Line through(const Eigen::VectorXd& z, const Eigen::VectorXd& u) {
    Line line{u.mean(), z.mean()};
    const Eigen::ArrayXd away = u.array() - line.middle_u;
    line.squares = away.square().sum();
    line.slope = (away * (z.array() - line.middle_z)).sum() / line.squares;
    return line;
  }
  double at(double u) const { return middle_z + slope * (u - middle_u); }
};

class DrawsCheck {
 public:
  DrawsCheck(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
             Comparisons& compare)
      : packing_(packing), ranges_(ranges), problem_(problem), compare_(compare) {}

  void run() {
    check_centre(packing_, ranges_, problem_, compare_);
    check_weights();
    check_drawn();
    check_estimate(0, ranges_.sample_R, ranges_.delta_R, "delta_R");
    check_estimate(1, ranges_.sample_T, ranges_.delta_T, "delta_T");
  }

 private:
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

  /// The value of each draw over M p.
  Eigen::VectorXd over_probability(const Eigen::VectorXd& values) const {
    const double mean_weight = ranges_.weight.cast<double>().sum() / static_cast<double>(values.size());
    Eigen::VectorXd result(ranges_.drawn.sum());
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      for (int k = 0; k < ranges_.drawn[i]; ++k) result[row++] = values[i] * mean_weight / ranges_.weight[i];
    }
    return result;
  }

  struct Estimate {
    double mean = Verification::kNaN, reach = mean;
  };

  /// Moments by pairs: Σ (z_i − z_j)² = 2K(K − 1) s².
  static Estimate by_mean(const Eigen::VectorXd& z) {
    const auto count = static_cast<double>(z.size());
    double pairs = 0;
    for (const double a : z) {
      for (const double b : z) pairs += (a - b) * (a - b);
    }
    Estimate result{z.sum() / count};
    if (count >= kFewestForInterval)
      result.reach =
          student_quantile(count - 1, (1 + kConfidence) / 2) * std::sqrt(pairs / (2 * (count - 1))) / count;
    return result;
  }

  /// The line through all draws, and for the error of each that through all others. None where those others
  /// have the same u.
  static Estimate by_regression(const Eigen::VectorXd& z, const Eigen::VectorXd& u, double mean_prediction) {
    const Eigen::Index count = z.size();
    if (count < kFewestForRegression) return by_mean(z);
    const double u_size = u.sum() / static_cast<double>(count);
    const auto without = [](const Eigen::VectorXd& values, Eigen::Index k) {
      Eigen::VectorXd others(values.size() - 1);
      others << values.head(k), values.tail(values.size() - 1 - k);
      return others;
    };
    const Line all = Line::through(z, u);
    double variance = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const Line others = Line::through(without(z, k), without(u, k));
      if (!(std::sqrt(others.squares / static_cast<double>(count - 1)) > kLeastSpread * u_size))
        return by_mean(z);
      // The weight of a draw in the mean is what the line of 0 … 1 … 0 has there.
      const double weight = Line::through(Eigen::VectorXd::Unit(count, k), u).at(mean_prediction);
      variance += std::pow(weight * (z[k] - others.at(u[k])), 2);
    }
    const double quantile = student_quantile(static_cast<double>(count - 2), (1 + kConfidence) / 2);
    return {all.at(mean_prediction), quantile * std::sqrt(variance)};
  }

  void check_estimate(int component, const SampleEstimate& stored, const Eigen::VectorXd& delta,
                      const std::string& name) {
    const Eigen::VectorXd z = over_probability(delta);
    Estimate right = by_mean(z);
    if (ranges_.estimator == DrawEstimator::kRegression) {
      const RebuiltPredictions predictions(packing_, ranges_, component);
      Eigen::VectorXd predicted(delta.size());
      for (Eigen::Index i = 0; i < delta.size(); ++i) predicted[i] = predictions.value(i, 0);
      const double mean = predicted.sum() / static_cast<double>(delta.size());
      right = by_regression(z, over_probability(predicted), mean);
    }
    compare_.equal(stored.mean, right.mean, "mean_" + name);
    compare_.equal(stored.low, right.mean - right.reach, "lower end of mean_" + name);
    compare_.equal(stored.high, right.mean + right.reach, "upper end of mean_" + name);
    const double band = kBandBias + kBandNoise / std::sqrt(static_cast<double>(z.size()));
    compare_.equal(stored.band, std::isnan(right.mean) ? right.mean : band, "band_" + name);
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
