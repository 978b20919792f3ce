#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/packing/packing.h"
#include "libindet/range/analysis_start.h"
#include "libindet/range/analyze_options.h"
#include "libindet/range/barrier_analysis.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Why the contacts of an analysis cannot be dealt, so that some are analysed here and others there: what is
/// found of one has to be the same whatever else is looked for. Nothing if they can, as far as can be told
/// before the polytope is found.
std::optional<std::string> obstacle_to_dealing(const AnalyzeOptions& options, int contacts);

/// An analysis in parts: what each finds is put together by join_ranges. The polytope and what all parts
/// share are found once a process, which takes a small part of the time of the values
/// (docs/decisions/dealt-analysis.md).
class DealtAnalysis {
 public:
  /// Throws InputError with the obstacle where there is one; Interrupted, LibraryError. `packing` must
  /// outlive this.
  DealtAnalysis(const Packing& packing, const AnalyzeOptions& options);
  DealtAnalysis(const DealtAnalysis&) = delete;
  DealtAnalysis& operator=(const DealtAnalysis&) = delete;

  /// All that are to be analysed, ascending.
  const std::vector<int>& contacts() const { return contacts_; }

  /// The ranges of some of these contacts, ascending. On any thread. Throws Interrupted.
  ForceRanges find(const std::vector<int>& contacts, int threads, const ProgressCallback& progress) const;

 private:
  AnalysisStart start_;
  std::vector<int> contacts_;
  std::optional<BarrierAnalysis> analysis_;
};

}  // namespace indet
