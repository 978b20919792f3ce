#include "libindet/range/width_predictions.h"

#include <algorithm>
#include <cmath>

#include "libindet/range/determined_forces.h"
#include "libindet/range/estimate_coefficients.h"

namespace indet {

WidthPredictions::WidthPredictions(const Packing& packing, const CentralWidths& widths, int dimension,
                                   bool tangential)
    : packing_(packing),
      widths_(widths),
      dimension_(dimension),
      tangential_(tangential),
      model_(tangential ? kModelOfT : kModelOfR) {
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < widths.width.rows(); ++i) {
    if (!can_vary(i)) continue;
    sum += width(i);
    ++count;
  }
  mean_width_ = sum / count;
}

bool WidthPredictions::can_vary(Eigen::Index contact) const {
  return !is_determined(packing_, widths_, contact, tangential_);
}

LogPrediction WidthPredictions::logarithm(Eigen::Index contact) const {
  return predict(model_, tangential_,
                 {width(contact), mean_width_, widths_.centre(contact, 0), widths_.centre(contact, 1),
                  widths_.width(contact, 0), widths_.width(contact, 1),
                  packing_[ContactId(static_cast<int>(contact))].mu, dimension_});
}

double WidthPredictions::ratio(Eigen::Index contact, double residual) const {
  const LogPrediction log = logarithm(contact);
  return std::max(2.0, std::exp(log.location + log.scale * residual));
}

Eigen::VectorXd WidthPredictions::deltas() const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(widths_.width.rows());
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    if (can_vary(i)) result[i] = width(i) * ratio(i, 0);
  }
  return result;
}

}  // namespace indet
