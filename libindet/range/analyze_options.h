#pragma once

#include <cstdint>
#include <optional>

#include "libindet/base/progress.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/range/contact_choice.h"
#include "libindet/range/duals.h"
#include "libindet/range/estimates.h"
#include "libindet/range/method.h"
#include "libindet/range/paper_options.h"
#include "libindet/range/state_choice.h"

namespace indet {

/// What an analysis is after (docs/accuracy.md has what each costs).
enum class Accuracy : std::uint8_t {
  kFast,     ///< ranges, certified as ever; extremal states are those where the solver lands
  kStandard  ///< canonical extremal states too
};

/// Up to some seconds (3 to 8 s where it did not suffice for arrays of 7 to 25 disks); what is left stays
/// marked.
inline constexpr double kUsualExactWork = 2e6;

struct AnalyzeOptions {
  std::optional<Method> method;  ///< nothing: chosen by size and by what is asked for (choose_method)
  double gap = 1e-6;             ///< of kBarrier: IntervalOptions::gap
  std::optional<Formulation>
      formulation;     ///< of kLp; nothing: chosen by size (docs/decisions/formulation.md)
  PaperOptions paper;  ///< of kPivotingPaper
  LpOptions lp;
  ContactChoice contacts;
  bool reactions = true;            ///< of walls and fixed disks: find their ranges, too
  bool smallest_distances = false;  ///< of the contacts whose ranges are found (distance_search.h)
  /// Estimates in place of ranges, by kBarrier, of all contacts: `contacts` and `states` do not matter.
  std::optional<EstimateOptions> estimate;
  /// Of kBarrier: which proofs of values the result keeps. Precondition: no states are kept, for these prove
  /// narrower bounds.
  DualChoice duals;
  StateChoice states;          ///< which extremal states the result keeps
  bool solver_states = false;  ///< where it keeps all canonical ones: also tell where the solver landed
                               ///< (ForceRanges::solver_states)
  /// Where rational arithmetic takes part, and how much of it (exact_ranges.h), in squares of the number of
  /// equations, summed over solves.
  enum class Exactness : std::uint8_t {
    kNowhere,
    kWhereNeeded,  ///< single values, then all results, that double precision leaves in doubt
    kEverywhere
  };
  Exactness exactness = Exactness::kWhereNeeded;
  double exact_work = kUsualExactWork;  ///< infinite: no limit
  int threads = 1;                      ///< the results do not depend on it
  ProgressCallback progress;
};

/// The options of a level of accuracy.
AnalyzeOptions options_for(Accuracy accuracy);

}  // namespace indet
