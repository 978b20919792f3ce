#include "libindet/verify/rebuilt_predictions.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/tolerances.h"
#include "libindet/range/estimate_coefficients.h"

namespace indet {

RebuiltPredictions::RebuiltPredictions(const Packing& packing, const ForceRanges& ranges, int component)
    : packing_(packing),
      ranges_(ranges),
      component_(component),
      model_(component == 0 ? kModelOfR : kModelOfT) {
  double sum = 0;
  double count = 0;
  for (Eigen::Index i = 0; i < ranges.width.rows(); ++i) {
    if (is_determined(i)) continue;
    sum += ranges.width(i, component);
    ++count;
  }
  mean_width_ = sum / count;
}

bool RebuiltPredictions::is_determined(Eigen::Index contact) const {
  const double mu = packing_[ContactId(static_cast<int>(contact))].mu;
  const double largest = (component_ == 1 && mu < 1 ? mu : 1) * ranges_.centre(contact, 0);
  return ranges_.width(contact, component_) <= tolerance::kDeterminedWidth * largest;
}

RebuiltPredictions::Expected RebuiltPredictions::expect(Eigen::Index contact) const {
  const double mu = packing_[ContactId(static_cast<int>(contact))].mu;
  const double normal = ranges_.centre(contact, 0);
  const double width = ranges_.width(contact, component_);
  const double ratios[] = {width / mean_width_, width / (component_ == 0 ? normal : mu * normal),
                           ranges_.width(contact, 1) / ranges_.width(contact, 0) / mu};
  double c[4];
  for (int n = 0; n < 3; ++n) c[n] = std::log(ratios[n]);
  c[3] = std::abs(ranges_.centre(contact, 1)) / (mu * normal);
  for (std::size_t n = 0; n < 4; ++n) {
    if (!(c[n] > model_.least[n])) c[n] = model_.least[n];  // or NaN
    if (c[n] > model_.largest[n]) c[n] = model_.largest[n];
  }
  const double D = std::log(std::log(ranges_.dim < 8 ? 8.0 : static_cast<double>(ranges_.dim)));
  const auto& a = model_.location;
  const auto& b = model_.scale;
  return {a[0] + a[1] * D + (a[2] + a[6] * c[0] + a[8] * D) * c[0] + (a[3] + a[7] * c[1] + a[9] * D) * c[1] +
              a[4] * c[2] + a[5] * c[3],
          std::exp(b[0] + b[1] * D + b[2] * c[0] + b[3] * c[1])};
}

double RebuiltPredictions::value(Eigen::Index contact, double residual) const {
  if (is_determined(contact)) return 0;
  const Expected expected = expect(contact);
  const double width = ranges_.width(contact, component_) / ranges_.force_unit;
  return width * std::max(2.0, std::exp(expected.location + expected.scale * residual));
}

}  // namespace indet
