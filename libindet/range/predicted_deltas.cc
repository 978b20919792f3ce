#include "libindet/range/predicted_deltas.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/range/estimate_coefficients.h"

namespace indet {
namespace {

class Predictor {
 public:
  Predictor(const Packing& packing, const ForceRanges& ranges, bool tangential)
      : packing_(packing),
        ranges_(ranges),
        tangential_(tangential),
        model_(tangential ? kModelOfT : kModelOfR),
        delta_(tangential ? ranges.delta_T : ranges.delta_R) {
    double sum = 0;
    int count = 0;
    for (Eigen::Index i = 0; i < delta_.size(); ++i) {
      if (!can_vary(i)) continue;
      sum += width(i);
      ++count;
    }
    mean_width_ = sum / count;
  }

  DeltaEstimates run(const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>& calibrates) const {
    std::vector<double> residuals;
    for (Eigen::Index i = 0; i < delta_.size(); ++i) {
      if (calibrates[i] == 0 || !can_vary(i) || !(delta_[i] > 0)) continue;
      const LogPrediction log = predict(model_, tangential_, situation(i));
      residuals.push_back((std::log(delta_[i] * ranges_.force_unit / width(i)) - log.location) / log.scale);
    }
    const bool has_enough = static_cast<int>(residuals.size()) >= fewest_for_conformal(kCoverage);
    const ResidualBand band =
        has_enough ? conformal_band(residuals, kCoverage) : band_by_law(residuals, model_.residuals);
    DeltaEstimates result;
    for (auto* values : {&result.estimate, &result.low, &result.high})
      values->setConstant(delta_.size(), kNaN);
    for (Eigen::Index i = 0; i < delta_.size(); ++i) {
      if (outcome(i) != Outcome::kEstimate) continue;
      const LogPrediction log = predict(model_, tangential_, situation(i));
      const double unit = width(i) / ranges_.force_unit;
      const auto at = [&](double residual) {
        return std::max(2 * unit, unit * std::exp(log.location + log.scale * residual));
      };
      result.estimate[i] = at(band.middle);
      result.low[i] = at(band.low);
      result.high[i] = at(band.high);
    }
    return result;
  }

 private:
  double width(Eigen::Index i) const { return ranges_.width(i, tangential_ ? 1 : 0); }
  Outcome outcome(Eigen::Index i) const { return ranges_.outcome(i, tangential_ ? kMinT : kMinR); }
  /// What is determined is enclosed in one interval for minimum and maximum.
  bool can_vary(Eigen::Index i) const { return outcome(i) == Outcome::kEstimate || !(delta_[i] == 0); }

  ContactSituation situation(Eigen::Index i) const {
    return {width(i),
            mean_width_,
            ranges_.centre(i, 0),
            ranges_.centre(i, 1),
            ranges_.width(i, 0),
            ranges_.width(i, 1),
            packing_[ContactId(static_cast<int>(i))].mu,
            ranges_.dim};
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  bool tangential_;
  const EstimateModel& model_;
  const Eigen::VectorXd& delta_;
  double mean_width_ = kNaN;
};

}  // namespace

Estimates predict_deltas(const Packing& packing, const ForceRanges& ranges, const EstimateOptions& options,
                         const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>& calibrates) {
  Estimates result;
  result.calibration = options.calibration;
  result.coverage = kCoverage;
  result.calibrates = calibrates;
  result.estimated_R = Predictor(packing, ranges, false).run(calibrates);
  result.estimated_T = Predictor(packing, ranges, true).run(calibrates);
  return result;
}

}  // namespace indet
