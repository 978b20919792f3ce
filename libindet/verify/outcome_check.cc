#include "libindet/verify/outcome_check.h"

#include <string>

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

void check_status(const ForceRanges& ranges, Comparisons& compare) {
  const std::string status = to_string(ranges.status);
  const auto require_dim = [&](PolytopeStatus meant, bool holds) {
    compare.require((ranges.status == meant) == holds, "status {} and dim {} contradict each other", status,
                    ranges.dim);
  };
  require_dim(PolytopeStatus::kEmpty, ranges.dim < 0);
  require_dim(PolytopeStatus::kPoint, ranges.dim == 0);
  const bool is_unbounded = ranges.status == PolytopeStatus::kUnbounded;
  const auto unbounded = (ranges.outcome == Outcome::kUnbounded).count();
  compare.require(is_unbounded || unbounded == 0, "status {}, yet {} values are unbounded", status,
                  unbounded);
  // In an unbounded polytope some normal force is: a ray in which all R are 0 has no T.
  const auto bounded = (ranges.outcome == Outcome::kOptimal || ranges.outcome == Outcome::kEnclosed).count();
  compare.require(!is_unbounded || bounded < ranges.outcome.size(), "status {}, yet all values are bounded",
                  status);
}

}  // namespace indet
