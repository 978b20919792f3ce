#pragma once

#include <optional>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/analysis_start.h"
#include "libindet/range/analyze_options.h"
#include "libindet/range/barrier_ranges.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The analysis of a packing by the barrier method, of all contacts or of some at a time. What the parts
/// share is found once, and no value, state, proof or distance depends on what else is looked for.
class BarrierAnalysis {
 public:
  /// `contacts`: all whose ranges are wanted, ascending. `widths`: of no rows where they are not known yet.
  /// `packing` and `start` must outlive this. Throws like prepare_barrier_ranges. Precondition: the method of
  /// `start` is kBarrier.
  BarrierAnalysis(const Packing& packing, const AnalysisStart& start, const std::vector<int>& contacts,
                  const CentralWidths& widths, const AnalyzeOptions& options);

  /// The ranges of some of these contacts; with the first of all, those of reactions. Nothing where linear
  /// programs find them better (may_be_left_to_programs). On any thread. Throws Interrupted.
  std::optional<ForceRanges> find(const std::vector<int>& contacts, const ContactRequest& request,
                                  int threads, const ProgressCallback& progress) const;

 private:
  void add_states(const std::vector<int>& contacts, const IntervalOptions& options,
                  BarrierRanges& found) const;

  const Packing& packing_;
  const AnalysisStart& start_;
  double gap_;
  bool smallest_distances_;
  BarrierPreparation prepared_;
};

/// Whether `BarrierAnalysis::find` may have nothing: F is unbounded, in a packing for which linear programs
/// soon find all.
bool may_be_left_to_programs(const ForcePolytope& polytope);

}  // namespace indet
