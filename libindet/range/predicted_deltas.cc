#include "libindet/range/predicted_deltas.h"

#include <cmath>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/range/width_predictions.h"

namespace indet {
namespace {

DeltaEstimates predict_component(const Packing& packing, const ForceRanges& ranges, bool tangential,
                                 const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>& calibrates) {
  const WidthPredictions predictions(packing, ranges, ranges.dim, tangential);
  const Eigen::VectorXd& delta = tangential ? ranges.delta_T : ranges.delta_R;
  const auto width = [&](Eigen::Index i) { return ranges.width(i, tangential ? 1 : 0) / ranges.force_unit; };
  std::vector<double> residuals;
  for (Eigen::Index i = 0; i < delta.size(); ++i) {
    if (calibrates[i] == 0 || !predictions.can_vary(i) || !(delta[i] > 0)) continue;
    const LogPrediction log = predictions.logarithm(i);
    residuals.push_back((std::log(delta[i] / width(i)) - log.location) / log.scale);
  }
  const bool has_enough = static_cast<int>(residuals.size()) >= fewest_for_conformal(kCoverage);
  const ResidualBand band = has_enough ? conformal_band(residuals, kCoverage)
                                       : band_by_law(residuals, predictions.model().residuals);
  DeltaEstimates result;
  for (auto* values : {&result.estimate, &result.low, &result.high}) values->setConstant(delta.size(), kNaN);
  for (Eigen::Index i = 0; i < delta.size(); ++i) {
    if (ranges.outcome(i, tangential ? kMinT : kMinR) != Outcome::kEstimate) continue;
    result.estimate[i] = width(i) * predictions.ratio(i, band.middle);
    result.low[i] = width(i) * predictions.ratio(i, band.low);
    result.high[i] = width(i) * predictions.ratio(i, band.high);
  }
  return result;
}

}  // namespace

Estimates predict_deltas(const Packing& packing, const ForceRanges& ranges, const EstimateOptions& options,
                         const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>& calibrates) {
  Estimates result;
  result.calibration = options.calibration;
  result.coverage = kCoverage;
  result.calibrates = calibrates;
  result.estimated_R = predict_component(packing, ranges, false, calibrates);
  result.estimated_T = predict_component(packing, ranges, true, calibrates);
  return result;
}

}  // namespace indet
