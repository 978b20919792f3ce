#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/estimate_model.h"
#include "libindet/range/estimates.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Predicts δR and δT where their outcome is kEstimate, each with an interval. With location f and scale s by
/// a model (estimate_model.h), and the residuals u_k = (ln(δ_k/σ_k) − f_k)/s_k of the contacts that
/// calibrate,
///
///   estimate = σ exp(f + s u),   low, high = σ exp(f + s u_∓),   none below 2σ,
///
/// where u, u_∓ are the band of one more residual (statistics/residual_band.h): a conformal one where there
/// are enough residuals, else the one by the law of the model. δ ≥ 2σ since F contains the Dikin ellipsoid.
/// The conformal interval rests on nothing but that the contacts were drawn with equal probabilities: over
/// draws, and over the contacts of a packing, it holds δ with the probability kCoverage at least, however bad
/// the model is. The other one rests on the packing being like those of the fit.
///
/// Preconditions: `ranges` has widths, values, measures and outcomes. `calibrates`: [M].
Estimates predict_deltas(const Packing& packing, const ForceRanges& ranges, const EstimateOptions& options,
                         const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>& calibrates);

}  // namespace indet
