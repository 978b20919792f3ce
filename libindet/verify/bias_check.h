#pragma once

#include "libindet/io/bias_file.h"
#include "libindet/io/sampling_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/verification.h"

namespace indet {

/// Checks the comparison of perturb-and-resolve (`chain`) with the uniform distribution of the same file:
/// radii and centres, means, Welch's test from stored means, deviations and effective sizes, numbers of
/// discoveries from the p-values (Benjamini and Hochberg), and the totals and means of the histograms.
/// `ranges`: of the same file, or null.
Verification verify_bias(const Packing& packing, const BiasRecord& bias, const SamplingRecord& chain,
                         const SamplingRecord& uniform, const ForceRanges* ranges);

}  // namespace indet
