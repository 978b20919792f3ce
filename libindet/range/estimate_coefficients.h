#pragma once

#include "libindet/range/estimate_model.h"

namespace indet {

// Fitted by bench/estimate/estimate.py on 2026-11-29 to 19 packings of 50 to 800 disks, friction 0.3, in a
// box (its list DESIGN), each with the same weight: limits of the covariates, location, scale, residuals.
// Within a packing ln(δ/σ) differs from the location by 0.33 (R) and 0.36 (T), root mean square; means over
// packings by 0.074 and 0.069.
inline constexpr EstimateModel kModelOfR = {
    {-6.863, -6.306, -4.866, 0},
    {1.87, -0.528, 1.897, 1},
    {1.03067, 0.21423, -0.05482, -0.18765, -0.02399, 0.10261, -0.03444, -0.01295, 0.0582, -0.03837},
    {-1.08803, 0.05967, -0.2556, 0.2651},
    {0.254, -2.081, 1.825}};
inline constexpr EstimateModel kModelOfT = {
    {-7.484, -7.939, -4.866, 0},
    {2.015, -0.344, 1.897, 1},
    {1.26927, 0.18798, -0.08518, -0.12263, -0.22642, 0.20321, -0.02141, -0.02999, 0.06125, -0.04818},
    {-1.25247, 0.08216, -0.16722, 0.14934},
    {0.198, -2.158, 1.857}};

}  // namespace indet
