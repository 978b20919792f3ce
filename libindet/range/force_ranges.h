#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>

#include "libindet/packing/packing.h"
#include "libindet/range/certify.h"
#include "libindet/range/contact_choice.h"
#include "libindet/range/duals.h"
#include "libindet/range/estimates.h"
#include "libindet/range/extrema.h"
#include "libindet/range/measures.h"
#include "libindet/range/outcome.h"
#include "libindet/range/problem_summary.h"
#include "libindet/range/reactions.h"
#include "libindet/range/smallest_distances.h"

namespace indet {

/// The ranges of all contact forces of one packing: what the stages of an analysis return, put together. Each
/// part says what its fields are; result_fields.h lists them with names, units and shapes. Contacts that were
/// not asked for have NaN, −1 and kNotRequested in every table, or, where δ is estimated, kEstimate.
///
///   ForcePolytope ─▶ ProblemSummary        ContactChoice ─▶ ContactRequest
///   ForcePolytope ─▶ Extrema ─▶ Enclosures ─▶ Certified ─▶ Measures ─▶ Estimates
///
/// Of Extrema the states and the work stay; its claims, its residuals and the enclosures are in Certified.
struct ForceRanges : ProblemSummary,
                     ContactRequest,
                     ExtremalStates,
                     SearchWork,
                     Certified,
                     Measures,
                     Estimates {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  std::map<std::string, double> seconds;  ///< By stage.
  /// Where asked for (AnalyzeOptions::solver_states); no field of files.
  std::optional<SolverStates> solver_states;
  Reactions reactions = {};         ///< Of walls and fixed disks; in files /reactions.
  Duals duals = {};                 ///< Of --method barrier, where asked for; in files /duals.
  SmallestDistances smallest = {};  ///< Where asked for (AnalyzeOptions::smallest_distances).
};

/// Certifies and measures what was found, and puts all of it together.
ForceRanges assemble(const Packing& packing, const ProblemSummary& problem, const ContactRequest& request,
                     const Extrema& extrema, const Enclosures& enclosures);

}  // namespace indet
