#pragma once

#include <string>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/analyze_options.h"
#include "libindet/range/method.h"
#include "libindet/range/state_choice.h"

namespace indet {

/// The method for a packing with this number of contacts, and why: kBarrier where it is the faster one for
/// values, or for values and canonical states, else kLp (docs/decisions/barrier-method.md).
struct MethodChoice {
  Method method = Method::kLp;
  std::string reason;
};
MethodChoice choose_method(int contacts, const StateChoice& states);

/// The extremal states that an analysis keeps, where its method has them: the choice with its limit, and as
/// the method takes it. Throws InputError if they do not go together.
StateChoice kept_states(const AnalyzeOptions& options, int contacts);

/// What an analysis has decided and found before it looks for values.
struct AnalysisStart {
  StateChoice kept;  ///< kept_states
  MethodChoice choice;
  ForcePolytope polytope;  ///< in the form that the method works on
};

/// Throws like kept_states; LibraryError.
AnalysisStart begin_analysis(const Packing& packing, const AnalyzeOptions& options);

}  // namespace indet
