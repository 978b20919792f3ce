#pragma once

#include <array>

#include "libindet/statistics/residual_band.h"

namespace indet {

/// What δ of one component (R or T) of a contact is predicted from. All but `dimension` are in one unit of
/// force.
struct ContactSituation {
  double width = 0;                 ///< σ of the component, > 0
  double mean_width = 0;            ///< its mean over the contacts whose component can vary
  double normal = 0;                ///< R at the analytic centre
  double tangential = 0;            ///< T there
  double width_R = 0, width_T = 0;  ///< σ of both components
  double mu = 0;
  int dimension = 0;  ///< dim F
};

/// A linear model of ln(δ/σ), fitted to packings all of whose ranges are known (bench/estimate/estimate.py).
/// The covariates have no unit, so that a packing twice as heavy has estimates twice as large:
///
///   c_1 = ln(σ/mean σ)    c_2 = ln(σ/R_c), of T ln(σ/μR_c)
///   c_3 = ln(σ_T/μσ_R)    c_4 = |T_c|/μR_c                   D = ln ln max(dim F, kLeastDimension)
///
///   location f = a_0 + a_1 D + a_2 c_1 + a_3 c_2 + a_4 c_3 + a_5 c_4
///                + a_6 c_1² + a_7 c_2² + a_8 c_1 D + a_9 c_2 D
///   scale    s = exp(b_0 + b_1 D + b_2 c_1 + b_3 c_2)
///
/// δ/σ grows ever more slowly with the size of a packing: its logarithm about linearly with D, from 50 to
/// 10000 disks. c_1 … c_4 count as the end of the range that they have in the packings of the fit where they
/// lie outside. The residual of a contact is (ln(δ/σ) − f)/s, and `residuals` tells what was found of these:
/// the part that is common to the contacts of a packing, and quantiles.
struct EstimateModel {
  static constexpr int kLeastDimension = 8;
  static constexpr int kCovariates = 4, kLocationTerms = 10, kScaleTerms = 4;
  std::array<double, kCovariates> least, largest;
  std::array<double, kLocationTerms> location;
  std::array<double, kScaleTerms> scale;
  ResidualLaw residuals;
};

/// Location and scale of ln(δ/σ).
struct LogPrediction {
  double location = 0, scale = 1;
};
/// Precondition: width > 0.
LogPrediction predict(const EstimateModel& model, bool tangential, const ContactSituation& contact);

}  // namespace indet
