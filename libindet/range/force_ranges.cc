#include "libindet/range/force_ranges.h"

namespace indet {

ForceRanges assemble(const Packing& packing, const ProblemSummary& problem, const ContactRequest& request,
                     const Extrema& extrema, const Enclosures& enclosures) {
  const Certified certified = certify(packing, problem, extrema, enclosures);
  return {problem, request,   extrema,
          extrema, certified, measure(packing, problem, request, extrema, certified),
          {},      {},        extrema.solver_states};
}

}  // namespace indet
