#pragma once

#include "libindet/range/estimate_model.h"

namespace indet {

// Fitted by bench/estimate/estimate.py on 2026-11-30 to 28 packings of 50 to 10000 disks, friction 0.3, in a
// box (its list DESIGN), each with the same weight: limits of the covariates, location, scale, residuals.
// Within a packing ln(δ/σ) differs from the location by 0.32 (R) and 0.35 (T), root mean square; means over
// packings by 0.079 and 0.076.
inline constexpr EstimateModel kModelOfR = {
    {-6.807, -6.17, -4.916, 0},
    {1.857, -0.527, 1.93, 1},
    {0.80591, 0.82942, -0.02454, -0.03038, -0.02096, 0.0863, -0.03786, -0.0082, 0.15225, -0.20537},
    {-1.00715, 0.04845, -0.24365, 0.22384},
    {0.268, -2.111, 1.803}};
inline constexpr EstimateModel kModelOfT = {
    {-7.269, -7.747, -4.916, 0},
    {2.016, -0.344, 1.93, 1},
    {1.01127, 0.73417, -0.03287, -0.01851, -0.2038, 0.19464, -0.02325, -0.03047, 0.15082, -0.22388},
    {-1.28432, 0.24598, -0.16378, 0.14551},
    {0.229, -2.081, 1.866}};

}  // namespace indet
