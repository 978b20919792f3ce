#include "libindet/verify/outcome_check.h"

#include "libindet/verify/comparisons.h"

namespace indet {

Verification verify_outcome(const std::string& outcome, const SamplingRecord* uniform,
                            const ForceRanges* ranges) {
  Comparisons compare("/uniform");
  if (uniform != nullptr) {
    const auto converged = uniform->numbers.find("converged");
    const bool has_converged = converged != uniform->numbers.end() && converged->second == 1;
    compare.require(outcome == (has_converged ? "converged" : "limit"), "outcome: \"{}\" is stored", outcome);
  } else if (ranges != nullptr) {
    compare.require(outcome == to_string(ranges->status), "outcome: \"{}\" is stored, but F is {}", outcome,
                    to_string(ranges->status));
  }
  return compare.result();
}

}  // namespace indet
