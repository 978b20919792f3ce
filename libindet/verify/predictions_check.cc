#include "libindet/verify/predictions_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"
#include "libindet/verify/centre_check.h"
#include "libindet/verify/rebuilt_predictions.h"

namespace indet {
namespace {

struct Band {
  double middle = 0, low = 0, high = 0;
};

class PredictionsCheck {
 public:
  PredictionsCheck(const Packing& packing, const ForceRanges& ranges, Comparisons& compare)
      : ranges_(ranges),
        compare_(compare),
        predictions_{RebuiltPredictions(packing, ranges, 0), RebuiltPredictions(packing, ranges, 1)} {}

  void run() {
    compare_.equal(ranges_.coverage, kCoverage, "coverage");
    compare_.require(ranges_.requested == std::min<Eigen::Index>(ranges_.calibration, variable_contacts()),
                     "requested: {} contacts, but {} are to calibrate", ranges_.requested,
                     ranges_.calibration);
    check_drawn();
    for (const int k : {0, 1}) {
      check_outcomes(k);
      check_component(k);
    }
  }

 private:
  bool is_determined(Eigen::Index i, int k) const {
    return predictions_[static_cast<std::size_t>(k)].is_determined(i);
  }
  int variable_contacts() const {
    int count = 0;
    for (Eigen::Index i = 0; i < ranges_.width.rows(); ++i)
      count += is_determined(i, 0) && is_determined(i, 1) ? 0 : 1;
    return count;
  }

  /// One after the other of the contacts that are left, by its place among them.
  void check_drawn() {
    std::vector<Eigen::Index> left;
    for (Eigen::Index i = 0; i < ranges_.width.rows(); ++i) {
      if (!is_determined(i, 0) || !is_determined(i, 1)) left.push_back(i);
    }
    std::vector<bool> drawn(static_cast<std::size_t>(ranges_.width.rows()), false);
    Random random(static_cast<std::uint64_t>(std::max<std::int64_t>(0, ranges_.sample_seed)));
    auto first = left.begin();
    for (int n = 0; n < ranges_.calibration && first != left.end(); ++n, ++first) {
      const auto ahead = random.below(static_cast<std::uint64_t>(left.end() - first));
      std::iter_swap(first, first + static_cast<std::ptrdiff_t>(ahead));
      drawn[static_cast<std::size_t>(*first)] = true;
    }
    for (Eigen::Index i = 0; i < ranges_.calibrates.size(); ++i)
      compare_.equal_count(ranges_.calibrates[i], drawn[static_cast<std::size_t>(i)] ? 1 : 0,
                           fmt::format("calibrates of contact {}", i));
    compare_.require((ranges_.sample_seed >= 0) == (ranges_.calibration > 0), "sample_seed: {} is stored",
                     ranges_.sample_seed);
  }

  void check_outcomes(int k) {
    for (Eigen::Index i = 0; i < ranges_.outcome.rows(); ++i) {
      const bool is_known = is_determined(i, k) || ranges_.calibrates[i] == 1;
      for (const int column : {2 * k, 2 * k + 1}) {
        const Outcome outcome = ranges_.outcome(i, column);
        compare_.require((outcome == Outcome::kEstimate) != is_known && outcome != Outcome::kNotRequested,
                         "contact {} {}: {}", i, to_string(static_cast<Column>(column)), to_string(outcome));
      }
    }
  }

  void check_component(int k) {
    const RebuiltPredictions& predictions = predictions_[static_cast<std::size_t>(k)];
    const DeltaEstimates& stored = k == 0 ? ranges_.estimated_R : ranges_.estimated_T;
    const Eigen::VectorXd& delta = k == 0 ? ranges_.delta_R : ranges_.delta_T;
    std::vector<double> residuals;
    for (Eigen::Index i = 0; i < delta.size(); ++i) {
      if (is_determined(i, k) || ranges_.calibrates[i] == 0 || !(delta[i] > 0)) continue;
      const RebuiltPredictions::Expected expected = predictions.expect(i);
      const double logarithm = std::log(delta[i]) - std::log(ranges_.width(i, k) / ranges_.force_unit);
      residuals.push_back((logarithm - expected.location) / expected.scale);
    }
    const Band band =
        residuals.size() >= 19 ? by_definition(residuals) : by_law(residuals, predictions.model().residuals);
    const std::string name = k == 0 ? "delta_R" : "delta_T";
    for (Eigen::Index i = 0; i < delta.size(); ++i) {
      const auto at = [&](const char* what) { return fmt::format("{}_{} of contact {}", name, what, i); };
      const bool is_estimate = ranges_.outcome(i, 2 * k) == Outcome::kEstimate;
      const auto value = [&](double residual) {
        return is_estimate ? predictions.value(i, residual) : Verification::kNaN;
      };
      compare_.equal(stored.estimate[i], value(band.middle), at("estimate"));
      compare_.equal(stored.low[i], value(band.low), at("low"));
      compare_.equal(stored.high[i], value(band.high), at("high"));
    }
  }

  static double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
  }

  /// Of the residuals and a new one, taken together, enough are as far from their mean as the new one.
  static bool is_in_band(const std::vector<double>& residuals, double added) {
    const auto count = static_cast<double>(residuals.size());
    const double middle = (mean(residuals) * count + added) / (count + 1);
    const auto as_far = std::count_if(residuals.begin(), residuals.end(), [&](double r) {
      return std::abs(r - middle) >= std::abs(added - middle);
    });
    return static_cast<double>(as_far) >=
           std::floor((1 - kCoverage) * (count + 1) * (1 + tolerance::kAgreement));
  }

  static Band by_definition(const std::vector<double>& residuals) {
    const double middle = mean(residuals);
    const auto [least, largest] = std::minmax_element(residuals.begin(), residuals.end());
    const auto end = [&](double outside) {
      double inside = middle;
      for (int halving = 0; halving < 100; ++halving) {
        const double between = inside + (outside - inside) / 2;
        (is_in_band(residuals, between) ? inside : outside) = between;
      }
      return inside;
    };
    const double reach = 2 * (*largest - *least);
    return {middle, end(middle - reach), end(middle + reach)};
  }

  static Band by_law(const std::vector<double>& residuals, const ResidualLaw& law) {
    // Precisions add up.
    const double own = static_cast<double>(residuals.size());
    const double prior = 1 / (law.shared * law.shared);
    const double middle = own * mean(residuals) / (own + prior);
    const double deviation = std::sqrt(1 + 1 / (own + prior));
    return {middle, middle + law.low * deviation, middle + law.high * deviation};
  }

  const ForceRanges& ranges_;
  Comparisons& compare_;
  std::array<RebuiltPredictions, 2> predictions_;  ///< of R and T
};

}  // namespace

void check_predictions(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                       Comparisons& compare) {
  check_centre(packing, ranges, problem, compare);
  PredictionsCheck(packing, ranges, compare).run();
}

}  // namespace indet
