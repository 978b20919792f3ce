#include "apps/ensemble/members/paper_walk_step.h"

#include "apps/ensemble/members/write_vector.h"
#include "libindet/range/analyze.h"

namespace indet {

PaperWalkResult walk_as_the_paper(const Packing& packing, const ProgressCallback& progress) {
  AnalyzeOptions options;
  options.method = Method::kPivotingPaper;
  options.states.kind = StateChoice::Kind::kSolver;
  options.progress = progress;
  const ForceRanges ranges = analyze(packing, options);
  return {.d_R = ranges.d_R,
          .d_T = ranges.d_T,
          .walks = ranges.paper.walk_count(),
          .failures = ranges.paper.failures(),
          .imprecise = ranges.imprecise + ranges.failed};
}

void write_paper_walk(Hdf5File& file, const PaperWalkResult& result) {
  file.set_attribute("/ensemble", "paper_walks", result.walks);
  file.set_attribute("/ensemble", "paper_failures", result.failures);
  file.set_attribute("/ensemble", "paper_imprecise", result.imprecise);
  write_vector(
      file, "/ensemble/paper_d_R", result.d_R,
      {"mg", "global indeterminacy of the normal force with the states where the paper's walk ends"});
  write_vector(
      file, "/ensemble/paper_d_T", result.d_T,
      {"mg", "global indeterminacy of the tangential force with the states where the paper's walk ends"});
}

}  // namespace indet
