#include "apps/estimate_arguments.h"

#include <fmt/format.h>

namespace indet::app {

EstimateOptions parse_estimate(const AnalysisArguments& arguments) {
  const auto refuse = [](const std::string& option, const char* reason) {
    throw UsageError(fmt::format("--accuracy estimate: {} {}", option, reason));
  };
  if (arguments.contacts != "all")
    refuse("--contacts " + arguments.contacts,
           "has no effect, all contacts are estimated; --calibrate says on how many they are calibrated");
  if ((arguments.states != "auto" && arguments.states != "none") || arguments.states_of != "all")
    refuse("--extremal-states and --states-of", "have no effect, as no extremal states are found");
  if (arguments.formulation != "auto")
    refuse("--formulation", "has no effect, as no linear programs are solved");
  if (arguments.reactions == "all") refuse("--reactions all", "has no effect, as no reactions are estimated");
  if (arguments.duals != "none")
    refuse("--duals " + arguments.duals, "has no effect, as estimates have no multipliers");
  EstimateOptions options;
  options.calibration = arguments.calibrate.value_or(options.calibration);
  options.seed = arguments.seed;
  if (options.calibration == 0 && arguments.seed != AnalysisArguments().seed)
    refuse("--seed", "has no effect with --calibrate 0, which draws no contacts");
  return options;
}

void resolve_calibration(const std::string& method, std::optional<double> gap, AnalyzeOptions& analysis) {
  constexpr double kGap = 1e-2;
  if (method != "auto" && method != to_string(Method::kBarrier))
    throw UsageError(fmt::format(
        "--accuracy estimate: --method {} has no effect, as contacts are calibrated by barrier", method));
  if (gap && analysis.estimate->calibration == 0)
    throw UsageError("--accuracy estimate: --gap has no effect with --calibrate 0, which finds no ranges");
  analysis.method = Method::kBarrier;
  analysis.gap = gap.value_or(kGap);
}

}  // namespace indet::app
