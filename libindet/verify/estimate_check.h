#pragma once

#include <string>
#include <vector>

#include "libindet/statistics/sample_estimate.h"
#include "libindet/verify/comparisons.h"

namespace indet {

/// Compares what is stored about the mean of δR or δT over all contacts with the `values` of the chosen ones.
/// Moments by pairs: Σ (x_i − x_j)² = 2K(K − 1) s², Σ (x_i − x_j)² (x_i + x_j − 2 mean) = 2K² γ s³. An end of
/// the interval is put into the equation of sample_estimate.h.
void check_estimate(const SampleEstimate& stored, const std::vector<double>& values, int contacts,
                    const std::string& name, Comparisons& compare);

}  // namespace indet
