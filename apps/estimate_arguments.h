#pragma once

#include <optional>
#include <string>

#include "apps/analysis_arguments.h"
#include "libindet/range/analyze.h"

namespace indet::app {

/// What is to be estimated. Of all contacts there are predictions, and no states: throws UsageError where
/// options ask for anything else. Precondition: is_estimate(arguments).
EstimateOptions parse_estimate(const AnalysisArguments& arguments);

/// How the contacts that calibrate are to be searched: by the barrier method, with the gap that was given,
/// else 1e-2, as the values need few digits. Throws UsageError where `method` (by its name, or "auto") or a
/// gap make no sense. Precondition: analysis.estimate.
void resolve_calibration(const std::string& method, std::optional<double> gap, AnalyzeOptions& analysis);

}  // namespace indet::app
