#pragma once

#include <string>

#include "libindet/io/sampling_file.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/verification.h"

namespace indet {

/// Checks the outcome that an ensemble stored of its uniform sampling (/uniform@outcome): with a sample it
/// says whether this converged ("converged", "limit"); without, why there is none, which is the status of the
/// ranges ("unbounded", "point", "empty"). `uniform` and `ranges`: of the same file, or null. With neither,
/// nothing is compared.
Verification verify_outcome(const std::string& outcome, const SamplingRecord* uniform,
                            const ForceRanges* ranges);

/// Compares the status of F with dim F and with the outcomes: an unbounded F has an unbounded value, where
/// all were sought, and any other has none.
void check_status(const ForceRanges& ranges, Comparisons& compare);

}  // namespace indet
