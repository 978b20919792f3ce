#pragma once

#include <Eigen/Core>

#include "libindet/packing/packing.h"
#include "libindet/range/central_widths.h"
#include "libindet/range/estimate_model.h"

namespace indet {

/// What the stored coefficients (estimate_coefficients.h) tell of δ of one component, R or T, of each contact
/// of a packing, from centre and widths of its polytope. Keeps references.
class WidthPredictions {
 public:
  /// `dimension`: dim F.
  WidthPredictions(const Packing& packing, const CentralWidths& widths, int dimension, bool tangential);

  const EstimateModel& model() const { return model_; }
  /// Whether the component is not determined (determined_forces.h).
  bool can_vary(Eigen::Index contact) const;
  /// Of ln(δ/σ). Precondition: can_vary.
  LogPrediction logarithm(Eigen::Index contact) const;
  /// δ/σ where the logarithm has this residual: exp(location + scale · residual), and at least 2, since F
  /// contains the Dikin ellipsoid. Precondition: can_vary.
  double ratio(Eigen::Index contact, double residual) const;
  /// [M] δ of residual 0, 0 where the component is determined; in the unit of the widths.
  Eigen::VectorXd deltas() const;

 private:
  double width(Eigen::Index contact) const { return widths_.width(contact, tangential_ ? 1 : 0); }

  const Packing& packing_;
  const CentralWidths& widths_;
  int dimension_;
  bool tangential_;
  const EstimateModel& model_;
  double mean_width_;
};

}  // namespace indet
