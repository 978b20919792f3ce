#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/estimate_model.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// What the stored coefficients tell of δ of one component (0: R, 1: T) of each contact, from the centre and
/// the widths in the file (range/width_predictions.h). The coefficients are those of the program. Keeps
/// references.
class RebuiltPredictions {
 public:
  /// ln(δ/σ) of a contact is expected at `location`, give or take `scale`.
  struct Expected {
    double location = 0, scale = 0;
  };

  RebuiltPredictions(const Packing& packing, const ForceRanges& ranges, int component);

  const EstimateModel& model() const { return model_; }
  bool is_determined(Eigen::Index contact) const;
  Expected expect(Eigen::Index contact) const;
  /// δ (mg) of a contact whose logarithm has this residual; 0 where it is determined.
  double value(Eigen::Index contact, double residual) const;

 private:
  const Packing& packing_;
  const ForceRanges& ranges_;
  int component_;
  const EstimateModel& model_;
  double mean_width_;
};

}  // namespace indet
